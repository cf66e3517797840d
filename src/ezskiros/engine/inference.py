"""Things for the parameters of a skill that are not given: what its pre-conditions allow.

A search through the things of the right classes, those with the fewest candidates first. Of several
solutions the first is taken, in the order of the parameters and of the names of things; the others
are told, unlike in SkiROS2, which takes one of them silently.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from ezskiros.check.inference import names
from ezskiros.engine.world import World
from ezskiros.ontology.statements import Statement
from ezskiros.skills.interface import Parameter, SkillInterface

MOST_SOLUTIONS = 10
"""More are not looked for."""


@dataclass(frozen=True)
class Inferred:
    """What the search has found: for each free parameter a thing, in each solution."""

    solutions: tuple[Mapping[str, str], ...]
    without_candidates: tuple[Parameter, ...] = ()
    """Parameters for which the world has nothing of their class."""


def infer(
    skill: SkillInterface, free: list[Parameter], given: Mapping[str, str], world: World
) -> Inferred:
    """Things for the free parameters so that all pre-conditions about things hold."""
    candidates = {each.name: world.things(each.iri or "") for each in free}
    empty = tuple(each for each in free if not candidates[each.name])
    if empty:
        return Inferred((), empty)
    statements = [clause.statement for clause in skill.pre]
    order = sorted((each.name for each in free), key=lambda name: len(candidates[name]))
    search = _Search(world, statements, order, candidates)
    found = []
    for solution in search.solutions(dict(given)):
        found.append({name: solution[name] for name in candidates})
        if len(found) == MOST_SOLUTIONS:
            break
    return Inferred(tuple(sorted(found, key=lambda each: [each[name] for name in candidates])))


@dataclass(frozen=True)
class _Search:
    """A search with backtracking; each condition is asked as soon as all of it is bound."""

    world: World
    statements: list[Statement]
    order: list[str]
    candidates: Mapping[str, list[str]]

    def solutions(self, bound: dict[str, str], depth: int = 0) -> Iterator[dict[str, str]]:
        if depth == len(self.order):
            yield dict(bound)
            return
        name = self.order[depth]
        asked = [each for each in self.statements if self._is_decided_by(each, name, bound)]
        for thing in self.candidates[name]:
            bound[name] = thing
            if all(self.world.holds(each, bound) for each in asked):
                yield from self.solutions(bound, depth + 1)
        bound.pop(name, None)

    def _is_decided_by(self, statement: Statement, name: str, bound: Mapping[str, str]) -> bool:
        about = names(statement)
        return name in about and all(each == name or each in bound for each in about)
