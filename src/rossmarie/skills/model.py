"""The parts of a skills file that rules need."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class SourcePlace:
    """A range of a source. Lines and columns count from 1; the end is after the last character.
    `path` is relative to the folder of the skills file.
    """

    path: str
    line: int
    column: int
    end_line: int
    end_column: int


@dataclass(frozen=True)
class SkillSource:
    """A file that the skills come from, and its SHA-256 in hexadecimal."""

    path: str
    sha256: str


@dataclass(frozen=True)
class OntologyClass:
    """A class of individuals, `skiros.Product`, and its parent classes."""

    name: str
    parents: tuple[str, ...]
    place: SourcePlace | None


@dataclass(frozen=True)
class IndividualProperty:
    """A data property of individuals: `float`, `int`, `bool` or `str`; `of` are its classes.
    Numbers of a property with a `unit` arrive in SI.
    """

    name: str
    type: str
    of: tuple[str, ...]
    unit: str | None
    place: SourcePlace | None


@dataclass(frozen=True)
class SkillParameter:
    """A parameter of a skill: its type is a class of individuals, or `float`, `int`, `bool`, `str`
    or `enum`. A needed parameter has a value before the skill starts. A given parameter gets its
    value from the program that starts the skill, and has no default. `default` is the default of a
    parameter with a number as default.
    """

    name: str
    type: str
    is_needed: bool
    is_given: bool
    place: SourcePlace | None
    default: float | None = None


@dataclass(frozen=True)
class PermissionLimit:
    """The limit of a permission: `value` in `unit`, or `si` in SI."""

    value: float
    unit: str
    si: float

    def __str__(self) -> str:
        """The limit as `30 N`."""
        return f"{self.value:g} {self.unit}"


@dataclass(frozen=True)
class Permission:
    """A permission of a skill, such as `contact`. `individuals` are pairs of a parameter and a
    class. The parameter is None if the description names a class.
    """

    kind: str
    individuals: tuple[tuple[str | None, str], ...]
    limit: PermissionLimit | None
    place: SourcePlace | None

    def __str__(self) -> str:
        """The permission as `contact with skiros.Product up to 30 N`."""
        named = [name for _, name in self.individuals]
        individuals = f" with {' and '.join(named)}" if named else ""
        return f"{self.kind}{individuals}" + (f" up to {self.limit}" if self.limit else "")


class UseKind(enum.Enum):
    """The kind of a resource that a skill commands."""

    TOPIC = "topic"
    SERVER = "server"


@dataclass(frozen=True)
class Use:
    """A topic or an action server that a skill commands, with its type if the description gives
    it.
    """

    kind: UseKind
    name: str
    type: str | None
    place: SourcePlace | None


@dataclass(frozen=True)
class ChildSkill:
    """A skill in a behavior tree. `arguments` maps the names of its parameters to texts: the name
    of a parameter of the compound skill, or a name that children share, or a Python value. It maps
    them to None for a computed value. `is_retried` is True if the tree can start the skill again
    after a failure.
    """

    skill: str
    arguments: Mapping[str, str | None]
    place: SourcePlace | None
    is_retried: bool


@dataclass(frozen=True)
class SkillCondition:
    """A condition of a skill, as written in the description, and as a JSON object."""

    text: str
    statement: Mapping[str, Any]
    place: SourcePlace | None


@dataclass(frozen=True)
class SkillConditions:
    """The conditions of a skill. It can start if all of `pre` are true; `hold` has to be true while
    it runs; after success, all of `post` are true.
    """

    pre: tuple[SkillCondition, ...]
    hold: tuple[SkillCondition, ...]
    post: tuple[SkillCondition, ...]


@dataclass(frozen=True)
class SkillNode:
    """A skill in a tree. `arguments` maps the names of its parameters to texts: the name of a
    parameter of the compound, or a written value; None for a value that is computed at run time.
    """

    skill: str
    arguments: Mapping[str, str | None]
    place: SourcePlace | None


@dataclass(frozen=True)
class Control:
    """An inner node of a tree, with its word in the file; empty if the file has none. `limit` is
    the time of a timeout in seconds, or the number of tries of a retry: a number, or a parameter of
    the compound; None if it is unknown.
    """

    kind: str
    children: tuple[Node, ...]
    place: SourcePlace | None
    limit: float | str | None = None


Node = SkillNode | Control


@dataclass(frozen=True)
class Skill:
    """A skill, by the name of its description. `parents` are the descriptions that it is derived
    from, `trees` its alternative trees, `children` all skills in these trees.
    """

    name: str
    parents: tuple[str, ...]
    parameters: Mapping[str, SkillParameter]
    conditions: SkillConditions
    permits: tuple[Permission, ...]
    uses: tuple[Use, ...]
    children: tuple[ChildSkill, ...]
    trees: tuple[Control, ...]
    place: SourcePlace | None


@dataclass(frozen=True)
class Location:
    """An individual in the scene, and its location: `corners` in m in the x-y plane of `frame`. One
    corner is a point; three or more are a polygon, anticlockwise; none means that the location is
    unknown.
    """

    iri: str
    label: str
    classes: tuple[str, ...]
    frame: str
    corners: tuple[tuple[float, float], ...]
    place: SourcePlace | None


@dataclass(frozen=True)
class SkillFile:
    """A skills file. `digest` identifies its sources; messages from this export contain it. The
    context is the topic of these messages, which arrive every `period_ns`.
    """

    digest: str
    sources: tuple[SkillSource, ...]
    topic: str
    message_type: str
    period_ns: int
    classes: Mapping[str, OntologyClass]
    properties: Mapping[str, IndividualProperty]
    skills: Mapping[str, Skill]
    locations: tuple[Location, ...] = ()
