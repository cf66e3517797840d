"""Checks of conditions against the ontology: domains and ranges of relations, and values of
properties.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from typing import TypeAlias

from dslkit.diagnostics import DeclaredHere, Diagnostic, Remark, Template, remarked
from ezskiros.check import errors
from ezskiros.check.values import is_value_of, spelled_types
from ezskiros.ontology import Ontology
from ezskiros.ontology.iris import split
from ezskiros.ontology.model import DataProperty, Model, Union
from ezskiros.ontology.python_names import identifier
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
from ezskiros.skills.interface import Clause, Parameter, SkillInterface
from ezskiros.skills.syntax import compared_value, names_in


def check_relations(skill: SkillInterface, ontology: Ontology) -> Iterator[Diagnostic]:
    """Report mismatches, in the order of the conditions."""
    checker = _Checker(skill, ontology)
    for clause in (*skill.pre, *skill.hold, *skill.post):
        for statement in simple(clause.statement):
            yield from checker.check(statement, clause)


def simple(statement: Statement) -> Iterator[Statement]:
    """A statement, or the parts of an `or`."""
    if isinstance(statement, AnyOf):
        for part in statement.parts:
            yield from simple(part)
    else:
        yield statement


def wanted(skill: SkillInterface, model: Model, subject: str, iri: str) -> tuple[Union, ...]:
    """The classes that a parameter must have to stand in a relation, by the range of the relation
    and by the class of the subject.
    """
    return (*model.range(iri), *model.only(skill.class_of(subject), iri))


Misfit: TypeAlias = type[errors.DoesNotFit] | type[errors.MayNotFit]


def misfit(model: Model, owl_class: str, union: Union) -> Misfit | None:
    """The reason why individuals of a class do not fit a union of classes; None if they fit."""
    if any(model.is_a(owl_class, each) for each in union):
        return None
    is_wider = any(model.is_a(each, owl_class) for each in union)
    return errors.MayNotFit if is_wider else errors.DoesNotFit


class _Checker:
    """The checks of one skill."""

    def __init__(self, skill: SkillInterface, ontology: Ontology) -> None:
        self._skill, self._ontology, self._model = skill, ontology, ontology.model

    def check(self, statement: Statement, clause: Clause) -> Iterator[Diagnostic]:
        """Report the mistakes in one statement."""
        match statement:
            case Relation(subject=subject, relation=iri, object=other):
                wrong = [*self._related(subject, iri, other, clause)]
                if len(wrong) == 2 and not [*self._related(other, iri, subject, clause)]:
                    name = identifier(split(iri)[1])
                    turned = errors.OtherDirection(other=other, property=name, subject=subject)
                    wrong = [remarked(wrong[0], help=turned)]
                yield from wrong
            case HasProperty(subject=subject, property=iri):
                yield from self._fits(subject, iri, self._model.domain(iri), clause)
            case ValueComparison(subject=subject, property=iri):
                yield from self._fits(subject, iri, self._model.domain(iri), clause)
                yield from self._value(statement, clause)
            case OfType() | Specified() | Generated() | AnyOf():
                pass

    def _related(self, subject: str, iri: str, other: str, clause: Clause) -> Iterator[Diagnostic]:
        yield from self._fits(subject, iri, self._model.domain(iri), clause)
        yield from self._fits(other, iri, wanted(self._skill, self._model, subject, iri), clause)

    def _fits(
        self, name: str, iri: str, wanted: tuple[Union, ...], clause: Clause
    ) -> Iterator[Diagnostic]:
        """Check that the class of a parameter fits a property."""
        parameter = self._skill.parameter(name)
        if parameter is None or parameter.iri is None:
            return
        for union in wanted:
            if kind := misfit(self._model, parameter.iri, union):
                yield self._misfit(kind, parameter, iri, union, clause)
                return

    def _misfit(
        self, kind: Misfit, parameter: Parameter, iri: str, union: Union, clause: Clause
    ) -> Diagnostic:
        assert parameter.iri is not None
        found = kind(
            parameter=parameter.name,
            found=self._spelled(parameter.iri),
            property=self._spelled(iri),
            wanted=" or ".join(self._spelled(each) for each in sorted(union)),
        )
        labels = [
            errors.DeclaredAs(owl_class=self._spelled(parameter.iri)).at(parameter.span),
            self._ontology.label(iri, errors.Relates()),
        ]
        return found.at(
            names_in(clause.span).get(parameter.name, clause.span), *filter(None, labels)
        )

    def _spelled(self, iri: str) -> str:
        return self._model.short(iri).replace(":", ".")

    def _value(self, statement: ValueComparison, clause: Clause) -> Iterator[Diagnostic]:
        declared = self._model.values.get(statement.property)
        if declared is None:
            return
        for union in self._model.range(declared.iri):
            names = spelled_types(union)
            if names and not is_value_of(statement.value, names):
                found = errors.WrongValue(
                    property=self._spelled(declared.iri),
                    found=repr(statement.value),
                    wanted=" or ".join(sorted(names)),
                )
                yield self._at_value(found, declared, clause)
        if declared.values is not None and str(statement.value) not in declared.values:
            yield self._unlisted(statement, declared, declared.values, clause)
        if statement.operator != "=" and isinstance(statement.value, (str, bool)):
            found_order = errors.NoOrder(operator=statement.operator, found=repr(statement.value))
            yield found_order.at(clause.span)

    def _unlisted(
        self,
        statement: ValueComparison,
        declared: DataProperty,
        known: frozenset[str],
        clause: Clause,
    ) -> Diagnostic:
        found = errors.UnlistedValue(
            property=self._spelled(declared.iri),
            found=repr(statement.value),
            values=", ".join(sorted(known)),
        )
        near = {each.lower(): each for each in sorted(known)}
        meant = difflib.get_close_matches(str(statement.value).lower(), near, n=1)
        help = found.Near(near=repr(near[meant[0]])) if meant else None
        return self._at_value(found, declared, clause, help)

    def _at_value(
        self, found: Template, declared: DataProperty, clause: Clause, help: Remark | None = None
    ) -> Diagnostic:
        """The finding at the compared value."""
        label = self._ontology.label(declared.iri, DeclaredHere())
        span = compared_value(clause.span) or clause.span
        return found.at(span, *([label] if label else []), help=help)
