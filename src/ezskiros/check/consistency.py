"""Conditions against each other: repeated ones, contradictions, two things where one can be."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf

from dslkit.diagnostics import Diagnostic, Label
from ezskiros.check import errors
from ezskiros.ontology import Ontology
from ezskiros.ontology.statements import TURNED, Comparison, Relation, Statement, negated
from ezskiros.skills.interface import Clause, SkillInterface

_CONSEQUENCES = {
    "pre": "the skill can never start",
    "hold": "the skill fails as soon as it starts",
    "post": "the skill can never succeed",
}


_REASONS = {
    False: "a thing is so related to at most one other",
    True: "at most one other is so related to a thing",
}


def check_consistency(skill: SkillInterface, ontology: Ontology) -> Iterator[Diagnostic]:
    """What is wrong with the conditions as sets."""
    for kind, before, clauses in (
        ("pre", (), skill.pre),
        ("hold", skill.pre, skill.hold),
        ("post", (), skill.post),
    ):
        others = list(before)
        seen: dict[Statement, Clause] = {}
        for clause in clauses:
            yield from _repeated(clause, seen, kind)
            yield from _contradicted(clause, others, kind)
            others.append(clause)
    yield from _functional(skill, ontology)


def _repeated(clause: Clause, seen: dict[Statement, Clause], kind: str) -> Iterator[Diagnostic]:
    first = seen.setdefault(clause.statement, clause)
    if first is not clause:
        yield errors.Repeated(kind=kind).at(clause.span, Label(first.span, "it is here"))


def _contradicted(clause: Clause, others: Sequence[Clause], kind: str) -> Iterator[Diagnostic]:
    for other in others:
        if _exclude(clause.statement, other.statement):
            found = errors.Contradiction(kind=kind, consequence=_CONSEQUENCES[kind])
            yield found.at(clause.span, Label(other.span, "this cannot hold at the same time"))
            return


def _exclude(one: Statement, other: Statement) -> bool:
    """Whether two statements cannot both hold."""
    if negated(one) == other:
        return True
    if not isinstance(one, Comparison) or not isinstance(other, Comparison):
        return False
    if (one.subject, one.property) != (other.subject, other.property):
        return False
    bounds = [*_bounds(one), *_bounds(other)]
    lowest = max((bound for sign, bound, _ in bounds if sign == ">"), default=-inf)
    highest = min((bound for sign, bound, _ in bounds if sign == "<"), default=inf)
    is_open = any(is_strict for _, bound, is_strict in bounds if bound == lowest)
    return lowest > highest or (lowest == highest and is_open)


def _bounds(said: Comparison) -> Iterator[tuple[str, float, bool]]:
    """From where, or up to where, a number is; and whether that is left out."""
    if isinstance(said.value, (str, bool)) or said.operator == "=":
        return
    operator = said.operator if said.is_true else TURNED[said.operator]
    yield operator[0], float(said.value), len(operator) == 1


def _functional(skill: SkillInterface, ontology: Ontology) -> Iterator[Diagnostic]:
    """After a skill nothing may have two objects of a functional relation, nor two subjects."""
    yield from _doubled(skill, skill.post, ontology, by_object=False)
    yield from _doubled(skill, skill.post, ontology, by_object=True)


def _doubled(
    skill: SkillInterface, clauses: Sequence[Clause], ontology: Ontology, *, by_object: bool
) -> Iterator[Diagnostic]:
    seen: dict[tuple[str, str], Clause] = {}
    for clause in clauses:
        said = clause.statement
        if not isinstance(said, Relation) or not said.is_true:
            continue
        declared = ontology.model.relations.get(said.relation)
        if declared is None:
            continue
        is_single = declared.is_inverse_functional if by_object else declared.is_functional
        if not is_single:
            continue
        one = said.object if by_object else said.subject
        first = seen.setdefault((said.relation, one), clause)
        if first.statement != said:
            found = errors.TwoPlaces(
                skill=skill.name,
                first=f"`{first.span.text}`",
                second=f"`{clause.span.text}`",
                relation=ontology.model.short(said.relation).replace(":", "."),
                kind="inverse functional" if by_object else "functional",
                reason=_REASONS[by_object],
            )
            yield found.at(clause.span, Label(first.span, "said here"))
