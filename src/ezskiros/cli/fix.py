"""`ezskiros check --fix`: adds missing pre-conditions of compound skills to their files."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from dslkit.writing import write_whole
from ezskiros.cli.checking import asked
from ezskiros.cli.output import output

if TYPE_CHECKING:  # the modules of the check are loaded when needed
    from ezskiros.contracts import MissingCondition


@dataclass(frozen=True)
class Repair:
    """The missing pre-conditions of a skill, and the place of the skill."""

    path: Path
    skill: str
    conditions: Sequence[str]


def fix(paths: Sequence[Path]) -> None:
    """Add missing pre-conditions and report this. The run ends if a file cannot be written."""
    from ezskiros.driver import missing_conditions

    found, _ = asked(lambda collector: _repairs(missing_conditions(paths, collector)))
    repairs = [Repair(Path(path), skill, conditions) for path, skill, conditions in found]
    for repair in repairs:
        output.try_change(repair.path)
    for repair in repairs:
        _write(repair)


def _repairs(missing: Sequence[MissingCondition]) -> list[tuple[str, str, list[str]]]:
    """Group repairs by skill: the file, the name, and the conditions."""
    found: dict[tuple[str, str], dict[str, None]] = {}
    for each in missing:
        place = (each.skill.span.file.path, each.skill.name)
        found.setdefault(place, {})[each.text] = None
    return [(*place, list(texts)) for place, texts in found.items()]


def _write(repair: Repair) -> None:
    from dslkit.source.python_file import read_python
    from ezskiros.repair.pre_conditions import with_pre_conditions

    try:
        encoding, text = read_python(repair.path)
        changed = with_pre_conditions(text, repair.skill, repair.conditions)
        if changed is None:
            typer.echo(f"{repair.path}: complete `{repair.skill}` by hand:", err=True)
        else:
            write_whole(repair.path, changed.encode(encoding))
            typer.echo(f"{repair.path}: added to `{repair.skill}`:", err=True)
    except (OSError, UnicodeError, SyntaxError) as problem:
        reason = getattr(problem, "strerror", None) or "it is not a Python text file"
        output.fail(f"cannot write {repair.path}: {reason.lower()}", exit_code=2)
    for each in repair.conditions:
        typer.echo(f"    {each}", err=True)
