"""Skills as actions of a planner: the needs and effects of each.

Parameters that stand for individuals are parameters of the action. `OPTIONAL` parameters are left
out, unless a condition uses them. Hold-conditions are required at the start.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from dslkit.diagnostics import Diagnostic
from ezskiros.check.inference import names
from ezskiros.ontology.model import Model
from ezskiros.ontology.statements import (
    AnyOf,
    Generated,
    HasProperty,
    OfType,
    Relation,
    Specified,
    Statement,
    ValueComparison,
)
from ezskiros.planning import errors
from ezskiros.planning.facts import EVERYTHING, About, Clause, Fluent, FluentLiteral, implied
from ezskiros.skills.calls import SkillClass
from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.skills.markers import Option, ParameterKind
from ezskiros.trees.library import Library

GONE = Fluent(About.GONE)


@dataclass(frozen=True)
class PlanningAction:
    """A skill. All `needs` must hold before it, and all `effects` hold after it, in order."""

    skill: SkillInterface
    description: SkillClass
    individuals: tuple[Parameter, ...]
    needs: tuple[Clause, ...]
    effects: tuple[FluentLiteral, ...]
    asserted: tuple[FluentLiteral, ...]
    """The effects that the skill states. The other effects follow from them."""
    apart: tuple[tuple[str, str], ...]
    """Pairs of parameters that stand for different individuals. All parameters do, unless their
    classes are disjoint anyway.
    """


class NotPlannableError(Exception):
    """A condition of a skill cannot be translated. The text gives the reason."""


def actions(library: Library, model: Model) -> tuple[list[PlanningAction], list[Diagnostic]]:
    """The actions of the checked skills, and the skills that no planner can use.

    As in SkiROS2, such a skill needs pre- and post-conditions, and an implementation, so that the
    plan can run. Skills that are not available for planning are left out.
    """
    drafts, found = [], []
    for description in library.checked:
        skill = library.skill(description)
        if skill is None:
            continue
        try:
            alternatives = _alternatives(description, skill, library)
            drafts += [_draft(each, description, model) for each in alternatives]
        except NotPlannableError as why:
            found.append(errors.SkillLeftOut(skill=skill.name, why=str(why)).at(skill.span))
    return [_with_consequences(each, drafts, model) for each in drafts], found


def _alternatives(
    description: SkillClass, skill: SkillInterface, library: Library
) -> list[SkillInterface]:
    """The skill as its implementations perform it: several variants if the implementations have
    their own pre-conditions. A plan calls the skill; the implementation is chosen at its start.
    """
    implementing = library.implementations(description).values()
    available = [each for each in implementing if each.available_for_planning]
    known = map(library.as_done_by, available) if implementing else [skill]
    alternatives = {id(each): each for each in known if each and each.pre and each.post}
    if alternatives and not implementing:
        raise NotPlannableError("these files have no implementation of the skill")
    return list(alternatives.values())


def _draft(skill: SkillInterface, description: SkillClass, model: Model) -> PlanningAction:
    """An action with the statements of the skill itself."""
    for parameter in skill.parameters:
        if parameter.is_individual and parameter.is_output:
            raise NotPlannableError(f"`{parameter.name}` is an output of the skill")
    clauses = [*skill.pre, *skill.hold, *skill.post]
    named = {name for each in clauses for name in names(each.statement)}
    individuals = tuple(
        each
        for each in skill.parameters
        if each.is_individual and (each.kind is not ParameterKind.OPTIONAL or each.name in named)
    )
    needs = [_clause(each.statement) for each in (*skill.pre, *skill.hold)]
    needs += [(FluentLiteral(GONE, (each.name,), False),) for each in individuals]
    needs += [(_of_class(each),) for each in individuals]
    asserted = [effect for each in skill.post for effect in _effects(each.statement)]
    asserted += [FluentLiteral(GONE, (e.name,)) for e in individuals if Option.CONSUME in e.options]
    return PlanningAction(
        skill,
        description,
        individuals,
        tuple(each for each in needs if each is not None),
        (),
        tuple(asserted),
        tuple(_apart(individuals, model)),
    )


def _of_class(parameter: Parameter) -> FluentLiteral:
    return FluentLiteral(Fluent(About.CLASS, parameter.iri or ""), (parameter.name,))


def _apart(individuals: Sequence[Parameter], model: Model) -> Iterator[tuple[str, str]]:
    for number, one in enumerate(individuals):
        for other in individuals[number + 1 :]:
            if not model.are_disjoint(one.iri or "", other.iri or ""):
                yield one.name, other.name


def _clause(statement: Statement) -> Clause | None:
    """The need of a condition; None if it always holds."""
    if isinstance(statement, AnyOf):
        if not statement.is_true:
            raise NotPlannableError("a condition requires that none of several conditions holds")
        parts = [_clause(part) for part in statement.parts]
        return None if None in parts else tuple(e for part in parts if part for e in part)
    if isinstance(statement, Specified):
        if not statement.is_true:
            raise NotPlannableError(f"a condition requires that `{statement.subject}` is not given")
        return None
    return (literal(statement),)


def literal(statement: Statement) -> FluentLiteral:
    """A single condition as a literal with parameters."""
    match statement:
        case Relation(subject=subject, relation=iri, object=other):
            return FluentLiteral(Fluent(About.RELATION, iri), (subject, other), statement.is_true)
        case ValueComparison(subject=subject, property=iri, operator=sign, value=value):
            compared = Fluent(About.COMPARISON, iri, sign, value)
            return FluentLiteral(compared, (subject,), statement.is_true)
        case HasProperty(subject=subject, property=iri):
            return FluentLiteral(Fluent(About.PROPERTY, iri), (subject,), statement.is_true)
        case OfType(subject=subject, owl_class=iri):
            return FluentLiteral(Fluent(About.CLASS, iri), (subject,))
        case Generated(subject=subject):
            return FluentLiteral(GONE, (subject,), not statement.is_true)
        case Specified() | AnyOf():
            raise NotPlannableError("a condition is of an unknown kind")


def _effects(statement: Statement) -> Iterator[FluentLiteral]:
    match statement:
        case AnyOf():
            raise NotPlannableError("a post-condition contains an `or`")
        case OfType():
            raise NotPlannableError("the skill changes the class of an individual")
        case Generated(is_true=True):
            raise NotPlannableError(f"the skill creates `{statement.subject}`")
        case ValueComparison(operator=sign) if sign != "=":
            raise NotPlannableError("a post-condition sets a property to an unknown number")
        case Specified():
            return
        case Relation() | ValueComparison() | HasProperty() | Generated():
            yield literal(statement)


# --- consequences ---------------------------------------------------------------------------------


def _with_consequences(
    action: PlanningAction, all_of: Sequence[PlanningAction], model: Model
) -> PlanningAction:
    """An action with all consequences of its effects that other actions use."""
    known = {
        each.fluent
        for other in all_of
        for each in (*other.asserted, *(part for clause in other.needs for part in clause))
    }
    effects: dict[tuple[Fluent, tuple[str, ...]], FluentLiteral] = {}
    for asserted in action.asserted:
        for each in (*_before(asserted, known, model), asserted, *_after(asserted, known, model)):
            effects.pop((each.fluent, each.arguments), None)
            effects[each.fluent, each.arguments] = each
    return PlanningAction(
        action.skill,
        action.description,
        action.individuals,
        action.needs,
        tuple(effects.values()),
        action.asserted,
        action.apart,
    )


def _before(asserted: FluentLiteral, known: set[Fluent], model: Model) -> Iterator[FluentLiteral]:
    """The old values that a new value of a functional relation replaces."""
    if asserted.fluent.about is not About.RELATION or not asserted.is_true:
        return
    subject, other = asserted.arguments
    for iri, is_forward in implied(asserted.fluent.iri, model):
        declared = model.relations.get(iri)
        fluent = Fluent(About.RELATION, iri)
        if declared is None or (fluent not in known and iri != asserted.fluent.iri):
            continue
        ends = (subject, other) if is_forward else (other, subject)
        if declared.is_functional:
            yield FluentLiteral(fluent, (ends[0], EVERYTHING), False)
        if declared.is_inverse_functional:
            yield FluentLiteral(fluent, (EVERYTHING, ends[1]), False)


def _after(asserted: FluentLiteral, known: set[Fluent], model: Model) -> Iterator[FluentLiteral]:
    fluent = asserted.fluent
    if fluent.about is About.RELATION:
        yield from _related(asserted, known, model)
        return
    about_same = [each for each in known if each.iri == fluent.iri and each != fluent]
    for each in sorted(about_same, key=repr):
        if each.about is About.COMPARISON and fluent.about is About.COMPARISON:
            if asserted.is_true:
                is_so = each.compares(fluent.value)
                yield FluentLiteral(each, asserted.arguments, is_so)
        elif each.about is About.COMPARISON and not asserted.is_true:
            yield FluentLiteral(each, asserted.arguments, False)
        elif each.about is About.PROPERTY and fluent.about is About.COMPARISON:
            yield FluentLiteral(each, asserted.arguments, asserted.is_true)


def _related(asserted: FluentLiteral, known: set[Fluent], model: Model) -> Iterator[FluentLiteral]:
    """Relations that become true, or false, together with a relation."""
    iri, ends = asserted.fluent.iri, asserted.arguments
    relations = sorted({each.iri for each in known if each.about is About.RELATION})
    for other in relations:
        if other == iri and not model.relations.get(iri):
            continue
        source, target = (iri, other) if asserted.is_true else (other, iri)
        for each, is_forward in implied(source, model):
            if each == target and (other, is_forward) != (iri, True):
                turned = ends if is_forward else (ends[1], ends[0])
                yield FluentLiteral(Fluent(About.RELATION, other), turned, asserted.is_true)
