"""From a rules file to the files of a target."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from dslkit.diagnostics import Diagnostic
from rossmarie.driver.pipeline import RulesError, compile_file
from rossmarie.ir import Machine
from rossmarie.targets import c99
from rossmarie.targets.base import Target

TARGETS: Mapping[str, Target] = {target.name: target for target in (c99.TARGET,)}


def generate(machine: Machine, target: str) -> Mapping[str, str]:
    """The files of a machine, by name. Raises `RulesError` for what the target cannot do."""
    if refused := tuple(TARGETS[target].unsupported(machine)):
        raise RulesError(refused)
    return TARGETS[target].generate(machine)


def build_files(
    rules: Path,
    target: str,
    folder: Path,
    *,
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
) -> tuple[list[Path], tuple[Diagnostic, ...]]:
    """Generate `target` for a rules file into `folder`; the paths written and the warnings.

    A file whose content would not change is not touched, so that a build system sees no change.
    Raises `RulesError` for errors in the rules and for what the target cannot do, and `OSError` if
    the folder cannot be written.
    """
    compiled = compile_file(rules, systems=systems, message_folders=message_folders)
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for name, text in generate(compiled.machine, target).items():
        path = folder / name
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8", newline="\n")
        written.append(path)
    return written, compiled.warnings
