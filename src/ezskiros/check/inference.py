"""Check that pre-conditions relate inferred parameters to given ones."""

from __future__ import annotations

from collections.abc import Iterator, Set
from dataclasses import dataclass

from dslkit.diagnostics import Diagnostic
from ezskiros.check import errors
from ezskiros.check.individuals import Individuals
from ezskiros.ontology import Ontology
from ezskiros.ontology.model import Model
from ezskiros.ontology.statements import AnyOf, Relation, Statement
from ezskiros.skills.interface import Clause, Parameter, SkillInterface
from ezskiros.skills.markers import ParameterKind

_MOST_NAMED = 3


@dataclass(frozen=True)
class Step:
    """A pre-condition from which a parameter is found, given another parameter."""

    parameter: str
    source: str
    clause: Clause


def chains(skill: SkillInterface) -> dict[str, Step]:
    """The last step to each inferred parameter that can be found.

    A relation that has to hold leads from one of its ends to the other (Paper IV, section 5).
    """
    known = [
        each.name
        for each in skill.parameters
        if each.is_individual and each.kind is ParameterKind.REQUIRED
    ]
    inferred = {each.name for each in skill.parameters if each.kind is ParameterKind.INFERRED}
    found: dict[str, Step] = {}
    while known:
        source = known.pop(0)
        for clause in skill.pre:
            said = clause.statement
            if not isinstance(said, Relation) or not said.is_true or said.is_abstract:
                continue
            ends = {said.subject: said.object, said.object: said.subject}
            target = ends.get(source)
            if target in inferred and target not in found and target is not None:
                found[target] = Step(target, source, clause)
                known.append(target)
    return found


def check_inference(
    skill: SkillInterface,
    ontology: Ontology,
    individuals: Individuals,
    implemented_with: Set[str],
) -> Iterator[Diagnostic]:
    """Report inferred parameters that no step leads to and that may be one of several individuals,
    and parameters that no condition uses.

    Parameters whose names are in `implemented_with` are left out, because implementations use them.
    """
    reached = chains(skill)
    clauses = (*skill.pre, *skill.hold, *skill.post)
    used = implemented_with | {name for clause in clauses for name in names(clause.statement)}
    used |= {
        individual.parameter
        for each in skill.permits
        for individual in each.individuals
        if individual.parameter
    }
    for parameter in skill.parameters:
        if parameter.iri is None:
            continue
        if parameter.kind is ParameterKind.INFERRED and parameter.name not in reached:
            if individuals.are_several(parameter.iri, ontology.model):
                yield _not_inferable(parameter, ontology.model, individuals)
        elif parameter.name not in used and not parameter.options:
            yield errors.UnusedParameter(parameter=parameter.name).at(parameter.span)


def _not_inferable(parameter: Parameter, model: Model, individuals: Individuals) -> Diagnostic:
    assert parameter.iri is not None
    known = [model.short(each) for each in individuals.of(parameter.iri, model)[:_MOST_NAMED]]
    any_of = model.short(parameter.iri).replace(":", ".") + " in the world"
    found = errors.NotInferable(
        parameter=parameter.name, candidates=f"of {', '.join(known)}" if known else any_of
    )
    return found.at(parameter.span)


def names(statement: Statement) -> tuple[str, ...]:
    """The parameters in a statement."""
    if isinstance(statement, AnyOf):
        return tuple(name for part in statement.parts for name in names(part))
    if isinstance(statement, Relation):
        return (statement.subject, statement.object)
    return (statement.subject,)
