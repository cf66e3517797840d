"""Answers of the running skills to the queries of a machine.

A context is a `skill_context_msgs/SkillContext`, with attributes as in rosbags, rospy and rclpy, or
a `SkillContext` of this module. The nodes have the same code in C++ (`runtime/ros/skills.h`).
Messages are not trusted: if a message violates its definition, comes from another export, or is too
large, the answer is NaN (unknown), so the input counts as stale.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol

from rossmarie.ir.path import Doing, Quantity, SkillStep

MOST_RUNNING = 64
"""The most skills that may run at the same time. A message with more skills is ignored."""
MOST_ARGUMENTS = 64
"""The most arguments of a skill. A message with more arguments is ignored."""
MOST_PROPERTIES = 64
"""The most properties of an argument. A message with more properties is ignored."""


@dataclass(frozen=True)
class SkillProperty:
    """A data property of an individual, in SI if it has a unit."""

    property: str
    number: float


@dataclass(frozen=True)
class SkillArgument:
    """An argument of a skill: an individual of a class (`type`, else empty), or a number (else
    NaN). An individual with several classes occurs once for each.
    """

    parameter: str
    value: str = ""
    type: str = ""
    number: float = math.nan
    properties: tuple[SkillProperty, ...] = ()


@dataclass(frozen=True)
class RunningSkill:
    """A running skill, by the name of its description, or a skill that can start next (`is_ahead`).
    Unknown arguments of the latter are missing.
    """

    skill: str
    arguments: tuple[SkillArgument, ...] = ()
    is_ahead: bool = False


@dataclass(frozen=True)
class SkillContext:
    """All skills that run and that can start next, and the digest of their export. If the skills
    that can start next are unknown, there are none in it.
    """

    digest: str
    running: tuple[RunningSkill, ...] = ()
    ahead: tuple[RunningSkill, ...] = ()
    is_ahead_known: bool = True

    @classmethod
    def of(cls, digest: str, skills: Iterable[RunningSkill]) -> SkillContext:
        """The context of skills that run and that can start next, in any order."""
        known = tuple(skills)
        running = tuple(each for each in known if not each.is_ahead)
        return cls(digest, running, tuple(each for each in known if each.is_ahead))


class SkillMessage(Protocol):
    """A `skill_context_msgs/SkillContext` of a ROS library, or a `SkillContext`. Its content may
    have any type.
    """

    @property
    def digest(self) -> str:
        """The digest of the export that contains the skills."""

    @property
    def running(self) -> Sequence[Any]:
        """The skills that run."""

    @property
    def ahead(self) -> Sequence[Any]:
        """The skills that can start next."""

    @property
    def is_ahead_known(self) -> bool:
        """True if the sender knows the skills that can start next."""


class _UnreadableError(Exception):
    """The message violates its definition, or is too large."""


def answer(step: SkillStep, context: SkillMessage) -> float:
    """The answer of a context to a query: 1.0 for yes, 0.0 for no, or the number of a `Quantity` as
    in the message. NaN if it is unknown, or if a boolean is neither 0 nor 1.
    """
    try:
        if _text(context, "digest") != step.export:
            return math.nan
        running = _skills(context, "running")
        ahead = _skills(context, "ahead", is_ahead=True)
        match step:
            case Doing(is_ahead=True):
                is_yes = any(_may_do(step, each) for each in ahead)
                return float(is_yes) if _is_ahead_known(context) else math.nan
            case Doing():
                return float(any(_is_doing(step, each) for each in running))
            case Quantity():
                return _quantity(step, running)
    except _UnreadableError:
        return math.nan


def _is_doing(step: Doing, running: RunningSkill) -> bool:
    return running.skill in step.skills and all(
        any(each.type in classes for each in _called(running, parameter))
        for parameter, classes in step.arguments
    )


def _may_do(step: Doing, ahead: RunningSkill) -> bool:
    """The answer for a skill that can start next."""
    known = {each.parameter for each in ahead.arguments}
    limits = tuple(limit for limit in step.arguments if limit[0] in known)
    return _is_doing(replace(step, arguments=limits), ahead)


def _quantity(step: Quantity, running: Sequence[RunningSkill]) -> float:
    asked = [each for each in running if each.skill in step.skills]
    if len(asked) != 1:
        return math.nan
    numbers = list(_numbers(step, asked[0]))
    is_one = bool(numbers) and all(each == numbers[0] for each in numbers[1:])
    if not is_one or (step.is_boolean and numbers[0] not in (0.0, 1.0)):
        return math.nan
    return numbers[0]


def _numbers(step: Quantity, running: RunningSkill) -> Iterator[float]:
    """The candidate numbers: for one individual, one for each of its classes."""
    for argument in _called(running, step.parameter):
        if step.property is None:
            yield argument.number
        else:
            yield from (p.number for p in argument.properties if p.property == step.property)


def _called(running: RunningSkill, parameter: str) -> Iterator[SkillArgument]:
    """The argument of a parameter, once for each class of an individual with several classes."""
    return (each for each in running.arguments if each.parameter == parameter)


# --- reading -----------------------------------------------------------------------------------


def _skills(context: SkillMessage, name: str, *, is_ahead: bool = False) -> list[RunningSkill]:
    return [_read(each, is_ahead) for each in _elements(context, name, MOST_RUNNING)]


def _read(skill: Any, is_ahead: bool) -> RunningSkill:
    arguments = tuple(_argument(each) for each in _elements(skill, "arguments", MOST_ARGUMENTS))
    return RunningSkill(_text(skill, "skill"), arguments, is_ahead)


def _argument(argument: Any) -> SkillArgument:
    return SkillArgument(
        _text(argument, "parameter"),
        type=_text(argument, "type"),
        number=_number(argument),
        properties=tuple(_properties(argument)),
    )


def _properties(argument: Any) -> Iterator[SkillProperty]:
    for each in _elements(argument, "properties", MOST_PROPERTIES):
        yield SkillProperty(_text(each, "property"), _number(each))


def _elements(owner: Any, name: str, most: int) -> Sequence[Any]:
    found = getattr(owner, name, None)
    if not isinstance(found, list | tuple) or len(found) > most:
        raise _UnreadableError
    return found


def _is_ahead_known(context: Any) -> bool:
    found = getattr(context, "is_ahead_known", None)
    if not isinstance(found, bool):
        raise _UnreadableError
    return found


def _text(owner: Any, name: str) -> str:
    found = getattr(owner, name, None)
    if not isinstance(found, str):
        raise _UnreadableError
    return found


def _number(owner: Any) -> float:
    found = getattr(owner, "number", None)
    if not isinstance(found, float | int):
        raise _UnreadableError
    try:
        return float(found)
    except OverflowError as error:
        raise _UnreadableError from error
