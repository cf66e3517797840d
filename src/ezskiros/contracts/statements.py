"""Conditions of a child, with the names of its tree."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from ezskiros.check.worlds import alternatives
from ezskiros.ontology.statements import AnyOf, Relation, Statement
from ezskiros.skills.interface import Clause


@dataclass(frozen=True)
class TreeCondition:
    """A statement of a condition with the names of a tree. `kind` is pre, hold or post."""

    statement: Statement
    clause: Clause
    kind: str


def asked(
    clauses: Iterable[Clause], kind: str, names: Mapping[str, str]
) -> Iterator[TreeCondition]:
    """The statements of conditions. A conjunction is split into its parts."""
    for clause in clauses:
        for each in conjuncts(clause.statement):
            yield TreeCondition(renamed(each, names), clause, kind)


def conjuncts(statement: Statement) -> tuple[Statement, ...]:
    """The statements that a statement implies: several for a negated `or`, otherwise the statement
    itself.
    """
    found = alternatives(statement)
    return found[0] if len(found) == 1 else (statement,)


def renamed(statement: Statement, names: Mapping[str, str]) -> Statement:
    """The same statement with other names."""
    if isinstance(statement, AnyOf):
        return replace(statement, parts=tuple(renamed(part, names) for part in statement.parts))
    subject = names.get(statement.subject, statement.subject)
    if isinstance(statement, Relation):
        return replace(
            statement, subject=subject, object=names.get(statement.object, statement.object)
        )
    return replace(statement, subject=subject)
