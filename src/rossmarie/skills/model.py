"""The contents of a file of skills, as far as rules ask."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Place:
    """A stretch of a source; lines and columns count from 1, the end is behind the last character.
    `path` is relative to the folder of the file of skills.
    """

    path: str
    line: int
    column: int
    end_line: int
    end_column: int


@dataclass(frozen=True)
class Source:
    """A file that the skills come from, and its SHA-256 in hexadecimal."""

    path: str
    sha256: str


@dataclass(frozen=True)
class SkillClass:
    """A class of things, `skiros.Product`, and those that it is derived from."""

    name: str
    parents: tuple[str, ...]
    place: Place | None


@dataclass(frozen=True)
class Property:
    """A data property of things: `float`, `int`, `bool` or `str`; `of` are the classes that have
    it. Numbers of a property with a `unit` arrive in SI.
    """

    name: str
    type: str
    of: tuple[str, ...]
    unit: str | None
    place: Place | None


@dataclass(frozen=True)
class Parameter:
    """A parameter of a skill: of a class of things, or `float`, `int`, `bool`, `str`, `enum`.
    One that is needed has a value before the skill starts; one that is given gets it from whoever
    starts the skill, and has no default. `default` is that of one that has a number for it.
    """

    name: str
    type: str
    is_needed: bool
    is_given: bool
    place: Place | None
    default: float | None = None


@dataclass(frozen=True)
class Limit:
    """The end of what is permitted: `value` in `unit`, which is `si` in SI."""

    value: float
    unit: str
    si: float

    def __str__(self) -> str:
        """`30 N`."""
        return f"{self.value:g} {self.unit}"


@dataclass(frozen=True)
class Permission:
    """A permission of a skill, such as `contact`. `things` are pairs of a parameter and a class;
    the parameter is None where the description names a class.
    """

    kind: str
    things: tuple[tuple[str | None, str], ...]
    limit: Limit | None
    place: Place | None

    def __str__(self) -> str:
        """`contact with skiros.Product up to 30 N`."""
        named = [name for _, name in self.things]
        things = f" with {' and '.join(named)}" if named else ""
        return f"{self.kind}{things}" + (f" up to {self.limit}" if self.limit else "")


class UseKind(enum.Enum):
    """The kind of something that a skill commands."""

    TOPIC = "topic"
    SERVER = "server"


@dataclass(frozen=True)
class Use:
    """A topic or an action server that a skill commands; its type, if the description says it."""

    kind: UseKind
    name: str
    type: str | None
    place: Place | None


@dataclass(frozen=True)
class Child:
    """A skill in a behavior tree. `arguments` are texts by the names of its parameters: the name of
    a parameter of the compound, or one that children share; or a value as Python has it; None for
    a value that is computed. `is_retried` tells that the tree can start the skill again after it
    has failed.
    """

    skill: str
    arguments: Mapping[str, str | None]
    place: Place | None
    is_retried: bool


@dataclass(frozen=True)
class Condition:
    """A condition of a skill: as a description writes it, and the same as an object of JSON."""

    text: str
    statement: Mapping[str, Any]
    place: Place | None


@dataclass(frozen=True)
class Conditions:
    """The conditions of a skill. It can start when all of `pre` hold; `hold` holds all the while;
    when it has succeeded, all of `post` hold.
    """

    pre: tuple[Condition, ...]
    hold: tuple[Condition, ...]
    post: tuple[Condition, ...]


@dataclass(frozen=True)
class Step:
    """A skill in a tree. `arguments` are texts by the names of its parameters: the name of one of
    the compound, or what is written; None for what is computed when the skill runs.
    """

    skill: str
    arguments: Mapping[str, str | None]
    place: Place | None


@dataclass(frozen=True)
class Control:
    """The node over others, by its word in the file; empty if the file has none. `limit` is that of
    a timeout in seconds, and the number of tries of a retry: a number, or the parameter of the
    compound that it is; None if nobody knows.
    """

    kind: str
    children: tuple[Node, ...]
    place: Place | None
    limit: float | str | None = None


Node = Step | Control


@dataclass(frozen=True)
class Skill:
    """A skill, by the name of its description; `parents` are the descriptions that it is derived
    from, `trees` the ways through it, `children` all skills in these.
    """

    name: str
    parents: tuple[str, ...]
    parameters: Mapping[str, Parameter]
    conditions: Conditions
    permits: tuple[Permission, ...]
    uses: tuple[Use, ...]
    children: tuple[Child, ...]
    trees: tuple[Control, ...]
    place: Place | None


@dataclass(frozen=True)
class Location:
    """A thing of the scene, and where it is: `corners` in m in the x-y plane of `frame`. One corner
    is a point, three or more are a polygon, anticlockwise; none mean that nobody knows where it is.
    """

    iri: str
    label: str
    classes: tuple[str, ...]
    frame: str
    corners: tuple[tuple[float, float], ...]
    place: Place | None


@dataclass(frozen=True)
class SkillFile:
    """A file of skills. `digest` stands for its sources; messages of that export carry it. The
    context is the topic on which these come, each `period_ns`.
    """

    digest: str
    sources: tuple[Source, ...]
    topic: str
    message_type: str
    period_ns: int
    classes: Mapping[str, SkillClass]
    properties: Mapping[str, Property]
    skills: Mapping[str, Skill]
    locations: tuple[Location, ...] = ()
