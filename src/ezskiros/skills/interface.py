"""A skill as data, for other skills and for planners."""

from __future__ import annotations

import enum
from collections.abc import Sequence
from dataclasses import dataclass

from dslkit.source import Span
from ezskiros.ontology.iris import THING
from ezskiros.ontology.statements import Statement, Value
from ezskiros.ontology.symbols import OntologyClass
from ezskiros.skills.markers import Option, ParameterKind
from ezskiros.skills.permits import Permission
from ezskiros.skills.uses import Use

BASIC = (str, int, float, bool)
ROBOT = "Robot"
"""The parameter that SkiROS2 adds to each skill: the robot that runs it."""


@dataclass(frozen=True)
class Parameter:
    """A parameter of a skill.

    `type` is a class of the ontology, a type of `BASIC`, or an enumeration. `default` is the value
    of a basic parameter without an argument; None if the argument is required. `other_key` is the
    SkiROS2 key, if it differs from the name.
    """

    name: str
    kind: ParameterKind
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
        """Say whether the skill sets the parameter."""
        return Option.OUTPUT in self.options

    @property
    def is_individual(self) -> bool:
        """Say whether the parameter stands for an individual."""
        return isinstance(self.type, OntologyClass)

    @property
    def iri(self) -> str | None:
        """The class of the individual; None if the parameter does not stand for one."""
        return self.type.iri if isinstance(self.type, OntologyClass) else None

    def takes(self, value: object) -> bool:
        """Say whether the parameter can have a basic value or a member of an enumeration. An
        integer is also a float here, but not in SkiROS2.
        """
        if self.type is float and type(value) is int:
            return True
        if issubclass(self.type, enum.Enum):
            return isinstance(value, self.type)
        return self.type in BASIC and type(value) is self.type


@dataclass(frozen=True)
class Clause:
    """A condition of a skill, and its place in the source."""

    statement: Statement
    span: Span


@dataclass(frozen=True)
class SkillInterface:
    """The description of a skill. A skill can start when all of `pre` hold. All of `hold` must hold
    while it runs, and all of `post` hold after its success. Permissions and uses are for rules.
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
    """The names of parameters with invalid types, which have been reported."""

    def parameter(self, name: str) -> Parameter | None:
        """The parameter with a name."""
        return next((each for each in self.parameters if each.name == name), None)

    def class_of(self, name: str) -> str:
        """The class of the individual of a parameter; owl:Thing for other parameters."""
        found = self.parameter(name)
        return (found.iri if found else None) or THING
