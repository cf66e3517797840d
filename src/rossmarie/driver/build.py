"""The build: from a rules file to the files of a target."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from dslkit.diagnostics import Diagnostic
from dslkit.source import SourceFile
from dslkit.writing import write_whole
from rossmarie.driver.ownership import check_own
from rossmarie.driver.package_folder import check_package_folder
from rossmarie.driver.pipeline import RulesError, check_file, compile_checked, compile_file
from rossmarie.ir import Category, Machine
from rossmarie.targets import c99, python, ros1, ros2
from rossmarie.targets.base import Target
from rossmarie.targets.copies import MARK
from rossmarie.targets.manifest import OWN_PACKAGE, Placement

TARGETS: Mapping[str, Target] = {
    target.name: target for target in (c99.TARGET, python.TARGET, ros1.TARGET, ros2.TARGET)
}


def check_for(
    target: str,
    rules: Path,
    *,
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
    only: Sequence[Category] = (),
) -> tuple[Diagnostic, ...]:
    """The findings on a rules file. Without errors, also the findings on features that this target,
    or any target, does not support.
    """
    result = check_file(rules, systems=systems, message_folders=message_folders, only=only)
    if result.program is None:
        return result.diagnostics
    try:
        machine = compile_checked(result, message_folders).machine
    except RulesError as error:
        return error.diagnostics
    return (*result.diagnostics, *TARGETS[target].unsupported(machine))


def generate(
    machine: Machine, target: str, placement: Placement = OWN_PACKAGE
) -> Mapping[str, str]:
    """The files of a machine, by name. Raises `RulesError` for unsupported features."""
    if refused := tuple(TARGETS[target].unsupported(machine)):
        raise RulesError(refused)
    return TARGETS[target].generate(machine, placement)


class Built(NamedTuple):
    """The result of a build: the paths of the generated files, the warnings, the next steps, if
    any, the source files, the texts of the rules' own code in C and C++ by name, and the rules
    outside a selection.
    """

    written: Sequence[Path]
    warnings: tuple[Diagnostic, ...]
    next_step: str | None
    sources: Sequence[SourceFile]
    own_code: Mapping[str, str]
    left_out: tuple[str, ...]


def build_files(
    rules: Path,
    target: str,
    folder: Path,
    *,
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
    only: Sequence[Category] = (),
    name: str | None = None,
    placement: Placement = OWN_PACKAGE,
    replaces_others: bool = False,
) -> Built:
    """Generate `target` for a rules file into `folder`, with `name` instead of the name of the
    file, and `only` rules of these categories.

    A file whose content would not change is not written, so that a build system sees no change. An
    existing file that belongs to the user is not written either. With `replaces_others`, files that
    were not generated from these rules are replaced.

    Raises `RulesError` for errors in the rules, for features that the target does not support, and
    for a folder that contains another package. Raises `ForeignFileError` if a present file was not
    generated from these rules. In all these cases no file is written. Raises `OSError` if the
    folder cannot be written.
    """
    compiled = compile_file(rules, systems=systems, message_folders=message_folders, only=only)
    machine = compiled.machine if name is None else replace(compiled.machine, name=name)
    files = generate(machine, target, placement)
    if found := check_package_folder(folder, files, rules):
        raise RulesError((*compiled.warnings, found))
    of_user = TARGETS[target].owned_by_user
    kept = set() if placement.part_of else {name for name in of_user if (folder / name).exists()}
    files = {name: text for name, text in files.items() if name not in kept}
    # In a part of a package, the user's own files have other places; these files are only examples.
    written = write_generated(
        files, folder, rules, unnamed=of_user, replaces_others=replaces_others
    )
    next_step = TARGETS[target].next_step(machine) if placement.part_of is None else None
    left_out = () if machine.left_out is None else machine.left_out.rules
    return Built(written, compiled.warnings, next_step, compiled.sources, own_code(files), left_out)


def own_code(files: Mapping[str, str]) -> dict[str, str]:
    """The code of these rules in C and C++, by file name, without the shared runtime."""
    return {
        name: text
        for name, text in files.items()
        if name.endswith((".h", ".c", ".cpp")) and MARK not in text.partition("\n")[0]
    }


def write_generated(
    files: Mapping[str, str],
    folder: Path,
    rules: Path,
    *,
    unnamed: Collection[str] = (),
    replaces_others: bool = False,
) -> list[Path]:
    """Write files that were generated from rules, by name, into a folder. Returns their paths.
    Raises the errors of `build_files`. Files that are `unnamed` do not name their rules.
    """
    changed = {}
    for name, text in files.items():
        path = folder / name
        present = path.read_bytes() if path.exists() else None
        if present is not None and name not in unnamed and not replaces_others:
            check_own(path, present, text, rules)
        if present != text.encode():
            changed[path] = text
    folder.mkdir(parents=True, exist_ok=True)
    for path, text in changed.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, text)
    return [folder / name for name in files]
