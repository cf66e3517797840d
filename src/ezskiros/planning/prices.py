"""Prices of actions: the time that a skill loses to rules at some places, from recorded runs.

A planner minimizes a sum of whole numbers. Each step costs `STEP`, plus its expected loss in tenths
of a second. So a step costs as much as one lost second.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from ezskiros.learning.lessons import Cost
from ezskiros.planning.actions import PlanningAction

STEP = 10
_HIGHEST = 1_000_000
"""The highest price, more than a day: sums of prices have to fit into 32 bits."""


@dataclass(frozen=True)
class Price:
    """A price of an action for certain individuals: one of `individuals`, each with the IRIs in the
    order of `parameters`.
    """

    cost: int
    parameters: tuple[str, ...]
    individuals: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Prices:
    """The prices of an action: the usual price, and the prices at places."""

    usual: int
    at_places: Sequence[Price] = ()


def prices(action: PlanningAction, costs: Iterable[Cost]) -> Prices:
    """The prices of an action. Places without any loss of time have the usual price."""
    known = {each.name for each in action.individuals}
    usual = STEP
    found: defaultdict[tuple[int, tuple[str, ...]], list[tuple[str, ...]]] = defaultdict(list)
    for each in costs:
        extra = min(round(each.expected_s * 10), _HIGHEST)
        names = tuple(name for name, _ in each.places)
        if each.skill != action.skill.name or extra == 0 or not known.issuperset(names):
            continue
        if names:
            found[extra, names].append(tuple(iri for _, iri in each.places))
        else:
            usual += extra
    at_places = [
        Price(STEP + extra, names, tuple(individuals))
        for (extra, names), individuals in found.items()
    ]
    return Prices(usual, at_places)


def expected_s(skill: str, individuals: Mapping[str, str], costs: Iterable[Cost]) -> float:
    """The expected loss of a step in seconds: a skill, with IRIs by parameter."""
    fitting = [
        each
        for each in costs
        if each.skill == skill and all(individuals.get(name) == iri for name, iri in each.places)
    ]
    at_places = [each.expected_s for each in fitting if each.places and each.lost_s]
    return min(at_places, default=sum(each.expected_s for each in fitting if not each.places))
