"""A skill as data, for other skills and for planners."""

from __future__ import annotations

import enum
from collections.abc import Sequence
from dataclasses import dataclass

from dslkit.source import Span
from ezskiros.ontology.iris import THING
from ezskiros.ontology.statements import Statement, Value
from ezskiros.ontology.things import ThingClass
from ezskiros.skills.markers import Kind, Option
from ezskiros.skills.permits import Permission
from ezskiros.skills.uses import Use

BASIC = (str, int, float, bool)
ROBOT = "Robot"
"""The parameter that SkiROS2 gives each skill: the agent that runs it."""


@dataclass(frozen=True)
class Parameter:
    """A parameter of a skill.

    `type` is a class of the ontology, or one of `BASIC`, or an enumeration. A `default` is the
    value of a basic parameter that is not given; None if it has to be. `other_key` is what SkiROS2
    calls it, if that is not its name.
    """

    name: str
    kind: Kind
    type: type
    span: Span
    default: Value | enum.Enum | None = None
    options: tuple[Option, ...] = ()
    doc: str = ""
    other_key: str | None = None

    @property
    def key(self) -> str:
        """The name of the parameter in SkiROS2."""
        return self.name if self.other_key is None else self.other_key

    @property
    def is_output(self) -> bool:
        """Say whether the skill gives it its value."""
        return Option.OUTPUT in self.options

    @property
    def is_thing(self) -> bool:
        """Say whether the parameter stands for something in the world."""
        return isinstance(self.type, ThingClass)

    @property
    def iri(self) -> str | None:
        """The class of the thing that it stands for; None if it stands for none."""
        return self.type.iri if isinstance(self.type, ThingClass) else None

    def takes(self, value: object) -> bool:
        """Say whether it can have a basic value, or one of an enumeration. A whole number is a
        float as well; in SkiROS2 it is none.
        """
        if self.type is float and type(value) is int:
            return True
        if issubclass(self.type, enum.Enum):
            return isinstance(value, self.type)
        return self.type in BASIC and type(value) is self.type


@dataclass(frozen=True)
class Clause:
    """A condition of a skill, and where it is written."""

    statement: Statement
    span: Span


@dataclass(frozen=True)
class SkillInterface:
    """The description of a skill. A skill can start when all of `pre` hold; `hold` holds all the
    while; when it has succeeded, all of `post` hold. What it permits and uses is for rules.
    """

    name: str
    span: Span
    parameters: Sequence[Parameter]
    pre: Sequence[Clause]
    hold: Sequence[Clause]
    post: Sequence[Clause]
    permits: Sequence[Permission] = ()
    uses: Sequence[Use] = ()
    doc: str = ""
    unclear: frozenset[str] = frozenset()
    """The names of parameters whose types were not understood, which has been reported."""

    def parameter(self, name: str) -> Parameter | None:
        """The parameter of that name."""
        return next((each for each in self.parameters if each.name == name), None)

    def class_of(self, name: str) -> str:
        """The class of the thing that a parameter stands for; of something else, owl:Thing."""
        found = self.parameter(name)
        return (found.iri if found else None) or THING
