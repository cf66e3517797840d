"""How inferred parameters get their values: by pre-conditions that relate them to given ones."""

from __future__ import annotations

from collections.abc import Iterator, Set
from dataclasses import dataclass

from dslkit.diagnostics import Diagnostic
from ezskiros.check import errors
from ezskiros.ontology import Ontology
from ezskiros.ontology.statements import AnyOf, Relation, Statement
from ezskiros.skills.interface import Clause, SkillInterface
from ezskiros.skills.markers import Kind


@dataclass(frozen=True)
class Step:
    """A parameter is found from another by a pre-condition."""

    parameter: str
    source: str
    clause: Clause


def chains(skill: SkillInterface) -> dict[str, Step]:
    """For each inferred parameter that something leads to, its last step.

    A relation that has to hold leads from one of its ends to the other (Paper IV, section 5).
    """
    known = [each.name for each in skill.parameters if each.is_thing and each.kind is Kind.REQUIRED]
    inferred = {each.name for each in skill.parameters if each.kind is Kind.INFERRED}
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
    skill: SkillInterface, ontology: Ontology, implemented_with: Set[str]
) -> Iterator[Diagnostic]:
    """Inferred parameters that nothing leads to, and parameters that no condition is about.

    Those are left out whose names are in `implemented_with`: names that implementations use.
    """
    reached = chains(skill)
    clauses = (*skill.pre, *skill.hold, *skill.post)
    used = implemented_with | {name for clause in clauses for name in names(clause.statement)}
    for parameter in skill.parameters:
        if parameter.iri is None:
            continue
        if parameter.kind is Kind.INFERRED and parameter.name not in reached:
            found = ontology.model.short(parameter.iri).replace(":", ".")
            finding = errors.NotInferable(parameter=parameter.name, found=found)
            yield finding.at(parameter.span)
        elif parameter.name not in used and not parameter.options:
            yield errors.UnusedParameter(parameter=parameter.name).at(parameter.span)


def names(statement: Statement) -> tuple[str, ...]:
    """The parameters that a statement is about."""
    if isinstance(statement, AnyOf):
        return tuple(name for part in statement.parts for name in names(part))
    if isinstance(statement, Relation):
        return (statement.subject, statement.object)
    return (statement.subject,)
