"""Goals that rules send to a task: the tree, its values, and the continuation of the task.

A goal is a `skill_context_msgs/Recover`. It names the export with which the rules were checked, so
that only trees run that the rules know.
"""

from __future__ import annotations

import enum
from collections.abc import Callable, Iterable, Sequence
from types import MappingProxyType
from typing import Protocol

from ezskiros.engine.arguments import WrongArgumentError, read_arguments
from ezskiros.engine.interruption import Afterwards, InterruptibleTask, Recovery
from ezskiros.engine.prohibitions import (
    Prohibition,
    UnknownProhibitionError,
    read_prohibition,
)
from ezskiros.engine.running import Running
from ezskiros.engine.values import WorldIndividual
from ezskiros.engine.world import World
from ezskiros.session import NOWHERE
from ezskiros.skills.calls import SkillCall, SkillClass
from ezskiros.skills.interface import SkillInterface

_PASSED = "@"
"""The prefix of a value that is the parameter of a running skill: `Target=@Drive.Target`."""


class RefusedGoalError(ValueError):
    """A goal that cannot be run. The text gives the reason."""


class Host(Protocol):
    """Runs skills, and trees instead of them. Raises `RefusedGoalError` while it cannot run a
    tree.
    """

    @property
    def known(self) -> dict[str, tuple[SkillClass, SkillInterface]]:
        """The skills by name."""
        ...

    @property
    def world(self) -> World:
        """The world with the names of individuals. Raises `RefusedGoalError`."""
        ...

    @property
    def running(self) -> Iterable[Running]:
        """The running skills of the task; while a tree runs, those that were running when it
        started.
        """
        ...

    def recover(self, recovery: Recovery) -> None:
        """Run a tree at the next tick. Raises `RefusedGoalError` if the tree can never run."""
        ...


class TaskHost:
    """A task of EzSkiROS's engine."""

    def __init__(self, task: InterruptibleTask) -> None:
        library = task.execution.library
        interfaces = ((each, library.skill(each)) for each in library.descriptions())
        self.known = {found.name: (each, found) for each, found in interfaces if found is not None}
        self.world, self.recover = task.execution.world, task.recover
        self._task = task

    @property
    def running(self) -> Iterable[Running]:
        """The running skills of the task."""
        return self._task.running


class RecoveryGoals:
    """Passes goals to a host. `digest` is the digest of the export of its skills."""

    def __init__(self, digest: str, host: Host) -> None:
        self._digest, self._host = digest, host

    def begin(
        self,
        digest: str,
        skill: str,
        arguments: Sequence[str],
        afterwards: str,
        without: Sequence[str],
        done: Callable[[bool, str], None],
    ) -> Recovery:
        """Run a tree at the next tick, and pass its result to `done`. `without` are the skills that
        rules always stop. Raises `RefusedGoalError`.
        """
        if digest != self._digest:
            raise RefusedGoalError("the rules were checked with another export of the skills")
        call = self._call(skill, arguments)
        try:
            going_on = Afterwards(afterwards)
        except ValueError:
            raise RefusedGoalError(f"a task cannot continue with `{afterwards}`") from None
        recovery = Recovery(call, going_on, done, self._prohibitions(without))
        self._host.recover(recovery)
        return recovery

    def _call(self, name: str, arguments: Sequence[str]) -> SkillCall:
        found = self._host.known.get(name)
        if found is None:
            raise RefusedGoalError(f"there is no skill `{name}`")
        description, interface = found
        try:
            texts = [self._resolved(text) for text in arguments]
            values = read_arguments(interface, texts, self._host.world)
        except WrongArgumentError as problem:
            raise RefusedGoalError(str(problem)) from None
        return SkillCall(description, None, MappingProxyType(values), NOWHERE)

    def _prohibitions(self, texts: Sequence[str]) -> tuple[Prohibition, ...]:
        skills = {name: skill for name, (_, skill) in self._host.known.items()}
        try:
            ontology = self._host.world.ontology
            return tuple(read_prohibition(each, skills, ontology) for each in texts)
        except UnknownProhibitionError as problem:
            raise RefusedGoalError(f"the list of forbidden skills is wrong: {problem}") from None

    def _resolved(self, text: str) -> str:
        """An argument with the current value of a running skill's parameter."""
        name, _, value = text.partition("=")
        if not value.startswith(_PASSED):
            return text
        skill, _, parameter = value.removeprefix(_PASSED).partition(".")
        found = {
            spelled
            for each in self._host.running
            if each.skill.name == skill
            and (spelled := _spelled(each.values().get(parameter))) is not None
        }
        if len(found) != 1:
            reason = "does not run" if not found else "runs several times with different values"
            raise RefusedGoalError(f"`{name}` takes its value from `{skill}`, which {reason}")
        return f"{name}={found.pop()}"


def _spelled(value: object) -> str | None:
    """A value in the syntax of `read_arguments`; None without a value."""
    match value:
        case None:
            return None
        case WorldIndividual():
            return value.iri
        case enum.Enum():
            return value.name
        case bool():
            return str(value).lower()
        case _:  # open: a number, or a text
            return str(value)
