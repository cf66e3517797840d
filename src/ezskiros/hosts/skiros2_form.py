"""A skill in SkiROS2's form: the data that its `addParam` and its conditions store.

Labels of conditions are left out, because they are for people. Names of the ontology are written as
in SkiROS2: `skiros:at`.
"""

from __future__ import annotations

import enum
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from ezskiros.ontology.model import Model
from ezskiros.ontology.statements import (
    AnyOf,
    Generated,
    HasProperty,
    OfType,
    Relation,
    Specified,
    Statement,
    Value,
    ValueComparison,
)
from ezskiros.skills.interface import ROBOT, Clause, Parameter, SkillInterface
from ezskiros.skills.markers import Option, ParameterKind

_STATE = "skiros:StateProperty"


@dataclass(frozen=True)
class FormParameter:
    """A parameter: `type` is `skiros:Product`, or the name of a Python class."""

    key: str
    kind: str
    type: str
    default: Value | enum.Enum | None = None


IMPLICIT_ROBOT = FormParameter(ROBOT, ParameterKind.INFERRED.value, "sumo:Agent")
"""The parameter that SkiROS2 adds to a skill without a parameter of this name."""


@dataclass(frozen=True)
class FormCondition:
    """A condition: the method of SkiROS2's `SkillDescription` that makes it, and its arguments
    after the label. `parts` are added to an `or`.
    """

    maker: str
    arguments: tuple[Value, ...]
    parts: tuple[FormCondition, ...] = ()


@dataclass(frozen=True)
class Form:
    """A description as SkiROS2 stores it."""

    name: str
    parameters: tuple[FormParameter, ...]
    pre: tuple[FormCondition, ...]
    hold: tuple[FormCondition, ...]
    post: tuple[FormCondition, ...]


def form_of(skill: SkillInterface, model: Model) -> Form:
    """The form of a skill whose types are from the ontology `model`."""
    lowering = _Lowering(model, {each.name: each.key for each in skill.parameters})
    parameters = [lowering.parameter(each) for each in skill.parameters]
    if all(each.key != ROBOT for each in parameters):
        parameters.append(IMPLICIT_ROBOT)
    pre, hold, post = lowering.options(skill.parameters)
    return Form(
        skill.name,
        tuple(parameters),
        (*pre, *lowering.clauses(skill.pre)),
        (*hold, *lowering.clauses(skill.hold)),
        (*post, *lowering.clauses(skill.post)),
    )


def conditions_of(
    skill: SkillInterface, clauses: Iterable[Clause], model: Model
) -> tuple[FormCondition, ...]:
    """The forms of some conditions on the parameters of a skill."""
    lowering = _Lowering(model, {each.name: each.key for each in skill.parameters})
    return tuple(lowering.clauses(clauses))


def any_of(parts: Iterable[FormCondition], *, is_true: bool) -> FormCondition:
    """An `or`. A nested `or` that is not negated is merged into it."""
    flat: list[FormCondition] = []
    for part in parts:
        is_open = part.maker == "getOrCond" and part.arguments == (True,)
        flat += part.parts if is_open else [part]
    return FormCondition("getOrCond", (is_true,), tuple(flat))


def options_of(key: str, kind: str, options: Iterable[str]) -> Iterator[tuple[str, FormCondition]]:
    """The conditions that the options of a parameter imply, each with the name of its list."""
    for option in options:
        if option == Option.CONSUME.value:
            yield "post", FormCondition("getGenerateCond", (key, False))
        elif option == Option.UNSPECIFY.value:
            yield "post", FormCondition("getIsSpecifiedCond", (key, False))
        elif option == Option.RESPECT_TYPE.value:
            yield "pre", FormCondition("getOnTypeCond", (key, kind))
        elif option == Option.LOCK.value:
            for place, is_idle in (("pre", True), ("hold", False), ("post", True)):
                yield place, FormCondition("getPropCond", (_STATE, key, "=", "Idle", is_idle))


class _Lowering:
    def __init__(self, model: Model, keys: Mapping[str, str]) -> None:
        self._model, self._keys = model, keys

    def parameter(self, found: Parameter) -> FormParameter:
        return FormParameter(found.key, found.kind.value, self._type(found), found.default)

    def _type(self, found: Parameter) -> str:
        return self._model.short(found.iri) if found.iri else found.type.__name__

    def options(self, parameters: Sequence[Parameter]) -> tuple[list[FormCondition], ...]:
        """The conditions before, during and after the skill that come from options."""
        found: dict[str, list[FormCondition]] = {"pre": [], "hold": [], "post": []}
        for each in parameters:
            names = [option.value for option in each.options]
            for kind, condition in options_of(each.key, self._type(each), names):
                found[kind].append(condition)
        return found["pre"], found["hold"], found["post"]

    def clauses(self, clauses: Iterable[Clause]) -> Iterator[FormCondition]:
        for clause in clauses:
            yield self._condition(clause.statement)

    def _condition(self, said: Statement) -> FormCondition:
        short, keys = self._model.short, self._keys
        match said:
            case Relation(subject=subject, relation=iri, object=other, is_abstract=is_abstract):
                maker = "getAbstractRelationCond" if is_abstract else "getRelationCond"
                return FormCondition(maker, (short(iri), keys[subject], keys[other], said.is_true))
            case ValueComparison(subject=subject, property=iri, operator=operator, value=value):
                arguments = (short(iri), keys[subject], operator, value, said.is_true)
                return FormCondition("getPropCond", arguments)
            case HasProperty(subject=subject, property=iri):
                return FormCondition("getHasPropCond", (short(iri), keys[subject], said.is_true))
            case OfType(subject=subject, owl_class=iri):
                return FormCondition("getOnTypeCond", (keys[subject], short(iri)))
            case Specified(subject=subject):
                return FormCondition("getIsSpecifiedCond", (keys[subject], said.is_true))
            case Generated(subject=subject):
                return FormCondition("getGenerateCond", (keys[subject], said.is_true))
            case AnyOf(parts=parts):
                return any_of(map(self._condition, parts), is_true=said.is_true)
