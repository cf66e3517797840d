"""From a rules file to the files of a target."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from dslkit.diagnostics import Diagnostic
from rossmarie.driver.pipeline import compile_file
from rossmarie.ir import Machine
from rossmarie.targets import c99

TARGETS: Mapping[str, Callable[[Machine], Mapping[str, str]]] = {"c99": c99.generate}


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
    Raises `RulesError` for errors in the rules, `OSError` if the folder cannot be written.
    """
    compiled = compile_file(rules, systems=systems, message_folders=message_folders)
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for name, text in TARGETS[target](compiled.machine).items():
        path = folder / name
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8", newline="\n")
        written.append(path)
    return written, compiled.warnings
