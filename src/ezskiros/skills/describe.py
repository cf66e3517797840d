"""A class that users wrote in, a `SkillInterface` out.

The patterns Early Dynamic Checking and Symbolic Tracing (thesis, Paper IV, section 4.2): the method
`description` is run with symbols in place of its parameters, as often as its branches ask for.
"""

from __future__ import annotations

import difflib
import inspect
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import FunctionType

from dslkit.diagnostics import Diagnostic, Label, Template
from dslkit.source import Span
from ezskiros import session
from ezskiros.ontology import Ontology
from ezskiros.ontology.things import UNKNOWN, ThingClass, symbol
from ezskiros.skills import errors
from ezskiros.skills.description import SkillDescription
from ezskiros.skills.interface import Clause, Parameter, SkillInterface
from ezskiros.skills.parameters import read_parameters, signature_of
from ezskiros.skills.syntax import class_span, definition, docs_of
from ezskiros.skills.tracing import Method, Way, ways
from ezskiros.skills.values import SymbolicValue


@dataclass(frozen=True)
class Described:
    """A skill, and the ontology that its types are from; None if it has no things.

    After a mistake it may not be whole: conditions may be missing.
    """

    interface: SkillInterface
    ontology: Ontology | None
    is_whole: bool


def describe(skill: type[SkillDescription]) -> Described | None:
    """What a skill says of itself; None if it says nothing, after a finding."""
    method = inspect.getattr_static(skill, "description", None)
    if not isinstance(method, FunctionType):
        session.report(_no_description(skill))
        return None
    if not _has_self(method):
        session.report(errors.NoSelf().at(definition(method).whole))
        return None
    docs = docs_of(inspect.getdoc(skill) or "")
    parameters = [
        replace(each, doc=docs[each.name]) if each.name in docs and not each.doc else each
        for each in read_parameters(method)
    ]
    runs = _explored(skill, method, parameters)
    first = runs[0]
    interface = SkillInterface(
        name=skill.__name__,
        span=class_span(skill),
        parameters=tuple(parameters),
        pre=first.pre,
        hold=first.hold,
        post=first.post,
        doc=inspect.cleandoc(skill.__doc__ or ""),
        unclear=_unclear(method, parameters),
    )
    types = (each.type for each in parameters)
    ontologies = [each.vocabulary for each in types if isinstance(each, ThingClass)]
    found = next((each for each in ontologies if isinstance(each, Ontology)), None)
    return Described(interface, found, all(run.are_whole for run in runs))


def _unclear(method: FunctionType, parameters: Sequence[Parameter]) -> frozenset[str]:
    """The names of the parameters that are written, without those that were understood."""
    written = list(signature_of(method).parameters)[1:]
    return frozenset(written) - {each.name for each in parameters}


def _no_description(skill: type[SkillDescription]) -> Diagnostic:
    """The finding for a skill without a description, with the method that may be meant."""
    methods = {
        name: each
        for name in dir(skill)
        if isinstance(each := inspect.getattr_static(skill, name), FunctionType)
    }
    found = errors.NoDescription(skill=skill.__name__)
    near = difflib.get_close_matches("description", methods, n=1, cutoff=0.7)
    if not near:
        return found.at(class_span(skill))
    is_old = near[0] == "createDescription"
    help = "`ezskiros migrate` translates `createDescription`" if is_old else None
    label = Label(definition(methods[near[0]]).whole, "did you mean `description`?")
    return found.at(class_span(skill), label, help=help)


def _has_self(method: FunctionType) -> bool:
    """Whether there is a place for the skill itself: one that has no type."""
    first = next(iter(signature_of(method).parameters.values()), None)
    return first is not None and (first.name == "self" or first.annotation is first.empty)


@dataclass(frozen=True)
class _Conditions:
    """The conditions of one way through a description."""

    pre: tuple[Clause, ...]
    hold: tuple[Clause, ...]
    post: tuple[Clause, ...]
    are_whole: bool
    """Whether none is missing after a mistake."""

    def statements(self) -> tuple[frozenset[object], ...]:
        return tuple(
            frozenset(each.statement for each in clauses)
            for clauses in (self.pre, self.hold, self.post)
        )


def _conditions(way: Way[SkillDescription]) -> _Conditions:
    """What a run has left in the instance that it was run on."""
    found = way.instance or _made(SkillDescription)
    kinds = (found.pre_conditions, found.hold_conditions, found.post_conditions)
    pre, hold, post = (tuple(each) for each in kinds)
    are_whole = way.has_ended and all(each.are_whole for each in kinds)
    return _Conditions(pre, hold, post, are_whole)


def _made(skill: type[SkillDescription]) -> SkillDescription:
    """An instance: to call a skill by its name is to make a child of a behavior tree."""
    made: SkillDescription = type.__call__(skill)
    return made


def _explored(
    skill: type[SkillDescription], function: FunctionType, parameters: Sequence[Parameter]
) -> list[_Conditions]:
    """All ways through the description until one has other conditions than the first."""

    def undefined(spelled: str) -> tuple[Template, str | None]:
        known = [*(each.name for each in parameters), *function.__globals__]
        near = difflib.get_close_matches(spelled, known, n=1)
        found = errors.UnknownParameter(spelled=spelled, skill=skill.__name__)
        return found, f"did you mean `{near[0]}`?" if near else None

    method = Method(
        skill,
        function,
        f"the description of `{skill.__name__}`",
        "a description only says what a skill needs and does; move this to its implementation",
        undefined,
    )

    def run(instance: SkillDescription, described_by: FunctionType) -> None:
        placed, named = _arguments(function, _symbols(parameters))
        described_by(instance, *placed, **named)

    found: list[_Conditions] = []
    for way in ways(method, lambda: _made(skill), run):
        conditions = _conditions(way)
        if not way.has_ended:
            return [conditions]
        if found and conditions.statements() != found[0].statements():
            session.report(_depends(skill, *way.decisions.last_planned()))
            break
        found.append(conditions)
    return found


def _symbols(parameters: Sequence[Parameter]) -> dict[str, object]:
    """What stands in the places of the parameters."""
    return {
        each.name: symbol(each.type, each.name)
        if isinstance(each.type, ThingClass)
        else SymbolicValue(each.name, each.type)
        for each in parameters
    }


def _depends(skill: type, span: Span, symbol: object) -> Diagnostic:
    """The finding for conditions that are others if a symbol is true."""
    if isinstance(symbol, SymbolicValue):
        return errors.DependsOnValue(skill=skill.__name__, parameter=repr(symbol)).at(span)
    return errors.DependsOnOutcome(skill=skill.__name__, call=repr(symbol)).at(span)


def _arguments(
    method: FunctionType, known: Mapping[str, object]
) -> tuple[list[object], dict[str, object]]:
    """The symbols, by place and by name; what is wrong gets something that all goes on with."""
    placed, named = [], {}
    for each in list(signature_of(method).parameters.values())[1:]:
        if each.kind is inspect.Parameter.POSITIONAL_ONLY:
            placed.append(known.get(each.name, UNKNOWN))
        elif each.kind not in _PACKED:
            named[each.name] = known.get(each.name, UNKNOWN)
    return placed, named


_PACKED = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)
