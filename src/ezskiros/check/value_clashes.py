"""Conditions on data properties that no value satisfies.

As in SkiROS2, an individual has a list of values. `==` tests whether a value is in the list, and
`!=` whether it is not in the list. Operators such as `<` test the first value, which must exist.
"""

from __future__ import annotations

import operator
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import combinations
from math import ceil, floor, inf
from typing import TypeAlias

from ezskiros.check import errors, world_errors
from ezskiros.check.clash import Clash, FactReason, KnownClasses
from ezskiros.check.limits import limits
from ezskiros.check.spelled import spelled_iri
from ezskiros.check.values import WHOLE, spelled_types
from ezskiros.ontology.model import Model
from ezskiros.ontology.statements import TURNED, HasProperty, ValueComparison, negated

Said: TypeAlias = ValueComparison | HasProperty
_COMPARES = {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge}


def value_clashes(said: Iterable[Said], classes: KnownClasses, model: Model) -> Iterator[Clash]:
    """Find contradictions among conditions on values."""
    found: dict[tuple[str, str], list[Said]] = defaultdict(list)
    for each in said:
        found[each.subject, each.property].append(each)
    for (individual, iri), about in found.items():
        values = _Values(individual, iri, classes, model)
        accepted: list[Said] = []
        for each in about:
            clash = values.clash(accepted, each)
            if clash:
                yield clash
            else:
                accepted.append(each)
        yield from values.several(accepted)


class _Values:
    """The possible values of a property of an individual."""

    def __init__(self, individual: str, iri: str, classes: KnownClasses, model: Model) -> None:
        self._individual, self._iri, self._name = individual, iri, spelled_iri(iri, model)
        known = limits(iri, classes.get(individual, {}), model)
        self._limit = min(known, key=lambda limit: limit.most, default=None)
        declared = model.values.get(iri)
        self._listed = declared.values if declared else None
        types = [spelled_types(union) for union in model.range(iri)]
        self._is_whole = any(names and names <= WHOLE for names in types)
        self._is_truth = any(names == {"boolean"} for names in types)

    def clash(self, accepted: Sequence[Said], said: Said) -> Clash | None:
        """The clash of a new condition with the smallest group of the others that excludes it."""
        for others in ([], *([other] for other in accepted), accepted):
            if found := self._excluded([*others, said]):
                return found
        return None

    def _excluded(self, said: Sequence[Said]) -> Clash | None:
        """The reason why some conditions cannot hold together."""
        together, asked = frozenset(said), _Asked(said)
        if any(negated(each) in together for each in said) or asked.leaves_no_number():
            return Clash(together, errors.Contradiction)
        if not asked.some:
            return None
        if self._limit and self._limit.most == 0:
            return self._limit.exceeded([FactReason(together)], self._individual)
        if asked.none:
            return self._none(together, f"without a {self._name} there is no value to compare")
        if not self._has_first(asked):
            return self._none(together, f"there is no such value of {self._name}")
        if asked.needs_several() and self._limit and self._limit.most == 1:
            found = self._limit.exceeded([FactReason(together)], self._individual)
            return replace(found, kind=world_errors.NoCommonValue)
        return None

    def several(self, accepted: Sequence[Said]) -> Iterator[Clash]:
        """Find pairs of conditions that need more than one value."""
        for pair in combinations(accepted, 2):
            if _Asked(pair).needs_several():
                why = f"{self._name} is not declared functional: SkiROS2 keeps a list of values"
                yield Clash(frozenset(pair), world_errors.TwoValues, (), why, (self._iri,))
                return

    def _none(self, said: frozenset[Said], why: str) -> Clash:
        return Clash(said, world_errors.NoCommonValue, (), why, (self._iri,))

    def _has_first(self, asked: _Asked) -> bool:
        """Say whether a value can be the first value."""
        if self._listed is not None and asked.named() <= self._listed:
            return any(map(asked.takes_text, self._listed))
        if self._is_truth:
            return any(map(asked.takes, (True, False)))
        if self._is_whole and -inf < asked.lowest and asked.highest < inf:
            numbers = range(ceil(asked.lowest), floor(asked.highest) + 1)
            return any(map(asked.takes, numbers[: len(asked.unequal) + 3]))
        return asked.lowest < asked.highest or asked.takes(asked.lowest)


class _Asked:
    """The demands of some conditions on the values of an individual."""

    def __init__(self, said: Iterable[Said]) -> None:
        compared = [each for each in said if isinstance(each, ValueComparison)]
        self.equal = {each.value for each in compared if each.operator == "=" and each.is_true}
        self.unequal = {
            each.value for each in compared if each.operator == "=" and not each.is_true
        }
        self.bounds = [
            (each.operator if each.is_true else TURNED[each.operator], each.value)
            for each in compared
            if each.operator != "=" and not isinstance(each.value, (str, bool))
        ]
        self.lowest = max((each for sign, each in self.bounds if sign[0] == ">"), default=-inf)
        self.highest = min((each for sign, each in self.bounds if sign[0] == "<"), default=inf)
        asked = {each.is_true for each in said if isinstance(each, HasProperty)}
        self.some = True in asked or bool(self.equal or self.bounds)
        self.none = False in asked

    def leaves_no_number(self) -> bool:
        """Say whether no number satisfies the comparisons by order."""
        if self.lowest == self.highest:
            return not self._is_within(self.lowest)
        return self.lowest > self.highest

    def takes(self, value: float) -> bool:
        """Say whether the first value can be this number."""
        return value not in self.unequal and self._is_within(value)

    def takes_text(self, text: str) -> bool:
        """Say whether the first value can be the number with this text."""
        if text in set(map(str, self.unequal)):
            return False
        return not self.bounds or (_is_number(text) and self._is_within(float(text)))

    def needs_several(self) -> bool:
        """Say whether one value cannot meet all demands."""
        numbers = [each for each in self.equal if not isinstance(each, (str, bool))]
        return len(self.equal) > 1 or not all(map(self._is_within, numbers))

    def named(self) -> set[str]:
        """The compared values, as texts."""
        return {
            str(each) for each in (*self.equal, *self.unequal, *(each for _, each in self.bounds))
        }

    def _is_within(self, value: float) -> bool:
        return all(_COMPARES[sign](value, bound) for sign, bound in self.bounds)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
