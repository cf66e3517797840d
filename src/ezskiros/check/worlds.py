"""Sets of conditions that hold together at one moment, with one alternative of each `or`.

The individuals are those of the parameters. A parameter that a condition declares as unset is left
out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import product

from ezskiros.check import errors
from ezskiros.check.clash import Clash, FactReason, KnownClasses
from ezskiros.check.entailed import entailed, relation_clashes
from ezskiros.check.inference import names
from ezskiros.check.value_clashes import value_clashes
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
    negated,
)

Literals = tuple[Statement, ...]
"""Statements without an `or`."""


def alternatives(statement: Statement) -> tuple[Literals, ...]:
    """The alternatives under which a statement holds."""
    if not isinstance(statement, AnyOf):
        return ((statement,),)
    if statement.is_true:
        return tuple(each for part in statement.parts for each in alternatives(part))
    parts = (negated(part) for part in statement.parts)
    found = product(*(alternatives(part) for part in parts if part is not None))
    return tuple(sum(each, ()) for each in found)


def certain(statements: Iterable[Statement]) -> Iterator[Statement]:
    """The statements that hold in each alternative of one of some statements."""
    for each in statements:
        found = alternatives(each)
        if len(found) == 1:
            yield from found[0]


def known_classes(declared: KnownClasses, said: Iterable[Statement]) -> KnownClasses:
    """The classes of individuals: the declared classes, and those that conditions require."""
    found = dict(declared)
    for each in said:
        if isinstance(each, OfType):
            known = found.get(each.subject, {})
            if each.owl_class not in known:
                found[each.subject] = {**known, each.owl_class: FactReason(frozenset({each}))}
    return found


class PossibleWorld:
    """Statements that hold together, about individuals with declared classes."""

    def __init__(self, declared: KnownClasses, model: Model, said: Iterable[Statement]) -> None:
        self._model, self._said = model, dict.fromkeys(said)
        self._present = list(_present(self._said))
        self._relations = [
            each for each in self._present if isinstance(each, Relation) and not each.is_abstract
        ]
        self.classes = known_classes(declared, self._present)
        self.facts = entailed((each for each in self._relations if each.is_true), model)

    def clashes(self) -> Iterator[Clash]:
        """Find contradictions."""
        yield from self._opposites()
        forbidden = [each for each in self._relations if not each.is_true]
        yield from relation_clashes(self.facts, forbidden, self.classes, self._model)
        values = (
            each for each in self._present if isinstance(each, (ValueComparison, HasProperty))
        )
        yield from value_clashes(values, self.classes, self._model)

    def _opposites(self) -> Iterator[Clash]:
        for each in self._said:
            opposite = None if each.is_true else negated(each)
            if opposite is not None and opposite in self._said:
                yield Clash(frozenset({each, opposite}), errors.Contradiction)


def _present(said: Iterable[Statement]) -> Iterator[Statement]:
    """Leave out statements about parameters without a value, because these are about any
    individual.
    """
    said = list(said)
    absent = {
        each.subject
        for each in said
        if isinstance(each, (Specified, Generated)) and not each.is_true
    }
    yield from (each for each in said if absent.isdisjoint(names(each)))
