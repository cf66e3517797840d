"""Goals of rules for a task: which tree, with which values, and how the task goes on.

A goal is a `skill_context_msgs/Recover`. It names the export that the rules were checked with, so
that no tree is run that they do not know.
"""

from __future__ import annotations

import enum
from collections.abc import Callable, Sequence
from types import MappingProxyType

from ezskiros.engine.arguments import WrongArgumentError, read_arguments
from ezskiros.engine.interruption import Afterwards, InterruptibleTask, Recovery
from ezskiros.engine.values import WorldThing
from ezskiros.session import NOWHERE
from ezskiros.skills.calls import SkillCall

_PASSED = "@"
"""Begins a value that is the parameter of a skill that runs: `Target=@Drive.Target`."""


class RefusedError(ValueError):
    """A goal that cannot be run; the text says why."""


class RecoveryGoals:
    """Hands goals to a task. `digest` is that of the export of its skills."""

    def __init__(self, digest: str, task: InterruptibleTask) -> None:
        self._digest, self._task = digest, task

    def begin(
        self,
        digest: str,
        skill: str,
        arguments: Sequence[str],
        afterwards: str,
        done: Callable[[bool, str], None],
    ) -> None:
        """Run a tree at the next tick; `done` is told how it ends. Raises `RefusedError`."""
        if digest != self._digest:
            raise RefusedError("the rules were checked with another export of the skills")
        self._task.recover(Recovery(self._call(skill, arguments), Afterwards(afterwards), done))

    def cancel(self) -> None:
        """The rule was released: the tree stops, and the task goes on."""
        self._task.release()

    def _call(self, name: str, arguments: Sequence[str]) -> SkillCall:
        setting = self._task.setting
        library = setting.library
        known = {each.__name__: each for each in library.descriptions()}
        description = known.get(name)
        interface = None if description is None else library.skill(description)
        if description is None or interface is None:
            raise RefusedError(f"there is no skill `{name}`")
        try:
            texts = [self._resolved(text) for text in arguments]
            values = read_arguments(interface, texts, setting.world)
        except WrongArgumentError as problem:
            raise RefusedError(str(problem)) from None
        return SkillCall(description, None, MappingProxyType(values), NOWHERE)

    def _resolved(self, text: str) -> str:
        """An argument with the value that a skill which runs has now."""
        name, _, value = text.partition("=")
        if not value.startswith(_PASSED):
            return text
        skill, _, parameter = value.removeprefix(_PASSED).partition(".")
        found = {
            spelled
            for each in self._task.setting.running
            if each.skill.name == skill
            and (spelled := _spelled(each.values().get(parameter))) is not None
        }
        if len(found) != 1:
            reason = "does not run" if not found else "runs several times, with several values"
            raise RefusedError(f"`{name}` is that of `{skill}`, which {reason}")
        return f"{name}={found.pop()}"


def _spelled(value: object) -> str | None:
    """A value as `read_arguments` reads it again; None if there is none."""
    match value:
        case None:
            return None
        case WorldThing():
            return value.iri
        case enum.Enum():
            return value.name
        case bool():
            return str(value).lower()
        case _:  # open: a number, or a text
            return str(value)
