"""A class that users wrote in, a `SkillInterface` out.

The patterns Early Dynamic Checking and Symbolic Tracing (thesis, Paper IV, section 4.2): the method
`description` is run with symbols in place of its parameters, as often as its branches ask for.
"""

from __future__ import annotations

import difflib
import inspect
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import FunctionType

from dslkit.diagnostics import Diagnostic, Label
from dslkit.source import Span
from ezskiros import session
from ezskiros.ontology import Ontology
from ezskiros.ontology.things import UNKNOWN, ThingClass, symbol
from ezskiros.skills import errors
from ezskiros.skills.blame import said, user_files, user_place
from ezskiros.skills.description import SkillDescription
from ezskiros.skills.guard import Interrupted, SideEffectError, TimeOverError, guarded
from ezskiros.skills.importing import forget_since, importing
from ezskiros.skills.intercept import intercept
from ezskiros.skills.interface import Clause, Parameter, SkillInterface
from ezskiros.skills.parameters import read_parameters, signature_of
from ezskiros.skills.syntax import class_span, definition, docs_of, file_of
from ezskiros.skills.values import MOST_PATHS, Decisions, Symbol, SymbolicValue, deciding

SECONDS = 5.0
"""For one run of one description."""


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
    classes = _classes(parameters)
    runs = _explored(skill, method, parameters, classes)
    first = runs[0]
    interface = SkillInterface(
        name=skill.__name__,
        span=class_span(skill),
        parameters=tuple(parameters),
        pre=first.pre,
        hold=first.hold,
        post=first.post,
        doc=inspect.cleandoc(skill.__doc__ or ""),
    )
    ontologies = [each.vocabulary for each in classes.values()]
    found = next((each for each in ontologies if isinstance(each, Ontology)), None)
    return Described(interface, found, all(run.is_whole for run in runs))


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


def _classes(parameters: Sequence[Parameter]) -> dict[str, ThingClass]:
    """The Python classes of the parameters that stand for things."""
    return {each.name: each.type for each in parameters if isinstance(each.type, ThingClass)}


@dataclass(frozen=True)
class _Run:
    """The conditions of one way through a description."""

    pre: tuple[Clause, ...]
    hold: tuple[Clause, ...]
    post: tuple[Clause, ...]
    has_ended: bool
    are_whole: bool
    """Whether no condition is missing after a mistake."""
    to_intercept: Sequence[str]
    """The files in which it could go further if their calls were intercepted."""

    @property
    def is_whole(self) -> bool:
        """Whether it says all that the description does."""
        return self.has_ended and self.are_whole

    def statements(self) -> tuple[frozenset[object], ...]:
        return tuple(
            frozenset(each.statement for each in clauses)
            for clauses in (self.pre, self.hold, self.post)
        )


def _explored(
    skill: type[SkillDescription],
    method: FunctionType,
    parameters: Sequence[Parameter],
    classes: dict[str, ThingClass],
) -> list[_Run]:
    """All ways through the description, as far as they are looked into.

    A name that is nowhere is told, and gets a substitute, so that what comes after it is looked at.
    """
    runs: list[_Run] = []
    planned: list[bool] | None = []
    substitutes: dict[str, object] = {}
    file, known = Path(file_of(skill)), dict(sys.modules)
    while planned is not None:
        decisions = Decisions(planned)
        names = len(substitutes)
        with importing(file), session.trying() as found:
            run = _run(skill, method, parameters, classes, decisions, substitutes)
        if intercept(run.to_intercept):
            forget_since(known)
            continue
        for diagnostic in found.sorted():
            session.report(diagnostic)
        if len(substitutes) > names:
            continue
        if not run.has_ended:
            return [run]
        if runs and run.statements() != runs[0].statements():
            session.report(_depends(skill, *decisions.asked[len(planned) - 1]))
            break
        runs.append(run)
        planned = decisions.following()
        if planned is not None and len(runs) >= MOST_PATHS:
            cut = errors.TooManyPaths(skill=skill.__name__, count=MOST_PATHS)
            session.report(cut.at(definition(method).whole))
            break
    return runs


def _depends(skill: type, span: Span, symbol: Symbol) -> Diagnostic:
    """The finding for conditions that are others if a symbol is true."""
    if isinstance(symbol, SymbolicValue):
        return errors.DependsOnValue(skill=skill.__name__, parameter=repr(symbol)).at(span)
    return errors.DependsOnOutcome(skill=skill.__name__, call=repr(symbol)).at(span)


def _run(
    skill: type[SkillDescription],
    method: FunctionType,
    parameters: Sequence[Parameter],
    classes: dict[str, ThingClass],
    decisions: Decisions,
    substitutes: dict[str, object],
) -> _Run:
    """One way through a description."""
    known = {
        each.name: symbol(classes[each.name], each.name)
        if each.name in classes
        else SymbolicValue(each.name, each.type)
        for each in parameters
    }
    instance, problem = None, None
    with guarded(SECONDS) as guard, deciding(decisions):
        try:
            instance = skill()
            placed, named = _arguments(method, known)
            _with_names(method, substitutes)(instance, *placed, **named)
        except (Exception, SystemExit, Interrupted) as raised:
            problem = raised
    for refusal in guard.refusals():
        session.report(errors.SideEffect(skill=skill.__name__, deed=refusal.deed).at(refusal.span))
    if problem is not None and not isinstance(problem, SideEffectError):
        session.report(_raised(skill, method, problem))
    missing = _missing_name(problem)
    if missing:
        substitutes[missing] = UNKNOWN
    to_intercept = [*guard.files, *([] if missing else user_files(problem))]
    conditions = instance if isinstance(instance, SkillDescription) else SkillDescription()
    kinds = (conditions.pre_conditions, conditions.hold_conditions, conditions.post_conditions)
    pre, hold, post = (tuple(each) for each in kinds)
    are_whole = conditions is instance and all(each.are_whole for each in kinds)
    return _Run(pre, hold, post, problem is None, are_whole, to_intercept)


def _missing_name(problem: BaseException | None) -> str | None:
    """The name that is defined nowhere, if that is the problem."""
    return problem.name if isinstance(problem, NameError) and type(problem) is NameError else None


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


def _with_names(method: FunctionType, names: Mapping[str, object]) -> FunctionType:
    """The function, for which some more names are defined in its module."""
    if not names:
        return method
    more = {**method.__globals__, **names}
    found = FunctionType(
        method.__code__, more, method.__name__, method.__defaults__, method.__closure__
    )
    found.__kwdefaults__ = method.__kwdefaults__
    return found


def _raised(skill: type, method: FunctionType, problem: BaseException) -> Diagnostic:
    """The finding for an exception, at the last place of the user's code that it came from."""
    span = user_place(problem) or definition(method).whole
    if isinstance(problem, TimeOverError):
        return errors.NeverEnds(skill=skill.__name__, seconds=SECONDS).at(span)
    if missing := _missing_name(problem):
        known = list(signature_of(method).parameters)[1:]
        near = difflib.get_close_matches(missing, [*known, *method.__globals__], n=1)
        help = f"did you mean `{near[0]}`?" if near else None
        return errors.UnknownParameter(spelled=missing, skill=skill.__name__).at(span, help=help)
    kind = type(problem).__name__
    return errors.Raised(skill=skill.__name__, exception=kind, said=said(problem)).at(span)
