"""The driver: runs the stages in order, from files to results. The stages make all decisions."""

from rossmarie.driver.pipeline import CheckResult, Compiled, RulesError, check_file, compile_file
from rossmarie.driver.workspace import SYSTEM_MODEL, read_source

__all__ = [
    "SYSTEM_MODEL",
    "CheckResult",
    "Compiled",
    "RulesError",
    "check_file",
    "compile_file",
    "read_source",
]
