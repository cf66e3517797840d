"""The class that users write: `class Pick(SkillDescription)`, with a method `description`."""

from __future__ import annotations

import difflib
from typing import Any

from dslkit.source import Span
from ezskiros import session
from ezskiros.ontology import condition_errors
from ezskiros.ontology.statements import Generated, OfType, Relation, Specified
from ezskiros.ontology.symbols import (
    UNKNOWN,
    Condition,
    OntologyClass,
    RelationOf,
    Thing,
    UnknownValue,
    described,
    is_asked_here,
)
from ezskiros.skills import errors
from ezskiros.skills.added import Added
from ezskiros.skills.calls import SkillClass
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.skills.interface import Clause
from ezskiros.skills.permits import Permits
from ezskiros.skills.syntax import added_value
from ezskiros.skills.uses import Uses


class Conditions(Added[Clause]):
    """The pre-, hold- or post-conditions of a skill: `self.pre_conditions += condition`."""

    def __init__(self, kind: str) -> None:
        super().__init__(f"{kind}_conditions")

    def __iadd__(self, condition: Condition | UnknownValue) -> Conditions:
        # Type checkers reject all other operands; for other users the mistake is reported here.
        if isinstance(condition, Condition) and not is_asked_here():
            self._items.append(Clause(condition.statement, condition.span))
            return self
        self.are_whole = False
        span = added_value(session.here())
        if isinstance(condition, RelationOf):
            condition.report_not_called(span)
        elif not isinstance(condition, (Condition, UnknownValue)) and not _is_reported(
            condition, span
        ):
            found = described(condition)
            session.report(condition_errors.NoCondition(found=found).at(span))
        return self

    def replaced_by(self, value: object) -> None:
        """Handle `=` like `+=`; the mistake has been reported."""
        self.are_whole = False
        if isinstance(value, Condition):
            self._items.append(Clause(value.statement, value.span))


def _is_reported(condition: object, span: Span) -> bool:
    """Say whether a condition is the result of `not condition`, which has been reported."""
    return isinstance(condition, bool) and session.has_reported(span)


class SkillDescription(metaclass=SkillClass):
    """A skill: its needs and its effects.

        class Drive(SkillDescription):
            def description(self, Robot: cora.Robot, Target: skiros.Location):
                self.post_conditions += Robot.at(Target)

    The parameters of the method are the parameters of the skill (thesis, Paper IV, listing 5).
    EzSkiROS runs the method with symbols as arguments and records the conditions. Users do not
    call it.
    """

    pre_conditions: Conditions
    hold_conditions: Conditions
    post_conditions: Conditions
    permits: Permits
    uses: Uses

    class SkillBase(SkillImplementation):
        """The base class for implementations of the skill. Each skill has its own."""

    def __init_subclass__(cls) -> None:
        parts = {"description": cls, "__module__": cls.__module__}
        cls.SkillBase = type("SkillBase", (SkillImplementation,), parts)  # type: ignore[misc, assignment]

    def __init__(self) -> None:
        self.pre_conditions = Conditions("pre")
        self.hold_conditions = Conditions("hold")
        self.post_conditions = Conditions("post")
        self.permits = Permits("permits")
        self.uses = Uses("uses")

    def __setattr__(self, name: str, value: object) -> None:
        if name in PARTS and name in self.__dict__ and value is not self.__dict__[name]:
            session.report(errors.ReplacedConditions(conditions=name).at(session.here()))
            self.__dict__[name].replaced_by(value)
            return
        object.__setattr__(self, name, value)

    def __getattr__(self, name: str) -> Added[Any]:
        """The attribute with the most similar name, after a finding."""
        near = difflib.get_close_matches(name, PARTS, n=1, cutoff=0.75)
        if name.startswith("__") or not near:
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
        session.report(errors.NoConditions(spelled=name, meant=near[0]).at(session.here()))
        meant: Added[Any] = self.__dict__[near[0]]
        return meant


PARTS = ("pre_conditions", "hold_conditions", "post_conditions", "permits", "uses")
"""The attributes that `self` has in a description."""


def specified(parameter: object) -> Condition | UnknownValue:
    """The condition that a parameter has a value."""
    individual = _individual(parameter, "specified")
    return Condition(Specified(individual), session.here()) if individual else UNKNOWN


def generated(parameter: object) -> Condition | UnknownValue:
    """The condition that an individual exists. As a post-condition, the skill creates the
    individual, or, with `~`, removes it.
    """
    individual = _individual(parameter, "generated")
    return Condition(Generated(individual), session.here()) if individual else UNKNOWN


def of_type(parameter: object, owl_class: object) -> Condition | UnknownValue:
    """The condition that an individual is of a class."""
    individual = _individual(parameter, "of_type")
    if individual is None or isinstance(owl_class, UnknownValue):
        return UNKNOWN
    if not isinstance(owl_class, OntologyClass):
        session.report(errors.NoClass(found=described(owl_class)).at(session.here()))
        return UNKNOWN
    return Condition(OfType(individual, owl_class.iri), session.here())


def abstract(condition: object) -> Condition | UnknownValue:
    """A relation between the classes of two individuals, instead of the individuals."""
    span = session.here()
    if isinstance(condition, UnknownValue):
        return condition
    if not isinstance(condition, Condition) or not isinstance(condition.statement, Relation):
        session.report(errors.NoRelation(found=described(condition)).at(span))
        return UNKNOWN
    found = condition.statement
    return Condition(
        Relation(found.subject, found.relation, found.object, found.is_true, True), span
    )


def _individual(parameter: object, function: str) -> str | None:
    """The name of the parameter; None, after a finding, if it does not stand for an individual."""
    if isinstance(parameter, Thing):
        return repr(parameter)
    if not isinstance(parameter, UnknownValue):
        found = described(parameter)
        session.report(
            condition_errors.NoIndividual(relation=function, found=found).at(session.here())
        )
    return None
