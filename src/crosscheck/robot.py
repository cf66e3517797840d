"""A robot in files: its rules, and their skills file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from crosscheck.errors import NoSkills
from dslkit.diagnostics import Diagnostic
from dslkit.source import Span
from rossmarie.check import CheckedProgram
from rossmarie.driver import RulesError
from rossmarie.driver.pipeline import check_file, compile_checked
from rossmarie.ir import Machine
from rossmarie.skills import Skill, SkillFile, SourcePlace
from rossmarie.syntax import ast


@dataclass(frozen=True)
class Robot:
    """Rules without errors, as syntax tree and as machine, and the skills file that they name."""

    modules: tuple[ast.Module, ...]
    program: CheckedProgram
    machine: Machine

    @property
    def skills(self) -> SkillFile:
        """All skills."""
        assert self.program.skills is not None, "a robot has skills"
        return self.program.skills.file

    def span_of(self, place: SourcePlace | None) -> Span:
        """A place in the skills; the start of the skills file if the place cannot be shown."""
        assert self.program.skills is not None
        return self.program.skills.span_at(place) or Span(self.program.skills.source, 0, 0)

    def callers(self, skill: str) -> Iterator[Skill]:
        """The compounds with a tree that contains a skill."""
        for each in self.skills.skills.values():
            if any(child.skill == skill for child in each.children):
                yield each


@dataclass(frozen=True)
class Loaded:
    """The robot, or None if there are errors; and all findings."""

    robot: Robot | None
    diagnostics: tuple[Diagnostic, ...]


def load(
    rules: Path, *, systems: Sequence[Path] = (), message_folders: Sequence[Path] = ()
) -> Loaded:
    """Read rules and the skills file that they name."""
    result = check_file(rules, systems=systems, message_folders=message_folders)
    if result.program is None:
        return Loaded(None, result.diagnostics)
    if result.program.skills is None:
        start = Span(result.modules[-1].file, 0, 0)
        return Loaded(None, (*result.diagnostics, NoSkills(rules=rules.name).at(start)))
    try:
        compiled = compile_checked(result, message_folders)
    except RulesError as error:
        return Loaded(None, error.diagnostics)
    robot = Robot(tuple(result.modules), result.program, compiled.machine)
    return Loaded(robot, result.diagnostics)
