"""The stages in order, files in and results out. Thin: it decides nothing itself."""

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
