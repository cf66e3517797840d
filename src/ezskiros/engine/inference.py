"""Inference of individuals for missing parameters, from the pre-conditions.

The search tries the individuals of the right classes. Of several solutions it takes the first one,
by the names of the individuals in the order of the parameters. The other solutions are reported;
SkiROS2 takes one silently.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from ezskiros.check.inference import names
from ezskiros.engine.conditions import holds
from ezskiros.engine.world import World
from ezskiros.ontology.statements import Relation, Statement, ValueComparison
from ezskiros.skills.interface import Parameter, SkillInterface

MOST_SOLUTIONS = 10
"""The most solutions that are reported."""

Solution = Mapping[str, str]


@dataclass(frozen=True)
class Inferred:
    """The result of the search: an individual for each free parameter, in each solution."""

    solutions: tuple[Solution, ...]
    without_candidates: tuple[Parameter, ...] = ()
    """Parameters without any individual of their class in the world."""


def infer(
    skill: SkillInterface,
    free: Sequence[Parameter],
    given: Mapping[str, str],
    world: World,
    *,
    is_equality: bool = False,
) -> Inferred:
    """Individuals for the free parameters that satisfy all pre-conditions about them.

    With `is_equality`, every comparison of a property tests for equality, as in SkiROS2.
    """
    candidates = {each.name: world.individuals(each.iri or "") for each in free}
    empty = tuple(each for each in free if not candidates[each.name])
    if empty:
        return Inferred((), empty)
    statements = [clause.statement for clause in skill.pre]
    if is_equality:
        statements = [_as_equality(each) for each in statements]
    candidates = _narrowed(candidates, given, statements, world)
    search = _Search(world, statements, list(candidates), candidates)
    solutions = []
    for solution in search.solutions(dict(given)):
        solutions.append({name: solution[name] for name in candidates})
        if len(solutions) == MOST_SOLUTIONS:
            break
    return Inferred(tuple(solutions))


def _as_equality(statement: Statement) -> Statement:
    return replace(statement, operator="=") if isinstance(statement, ValueComparison) else statement


def _narrowed(
    candidates: Mapping[str, list[str]],
    given: Mapping[str, str],
    statements: Sequence[Statement],
    world: World,
) -> dict[str, list[str]]:
    """The candidates that have the relations of a condition.

    The search would exclude the others too, but only after it has tried them with all other
    candidates.
    """
    known = {name: {individual} for name, individual in given.items()}
    known |= {name: set(individuals) for name, individuals in candidates.items()}
    before = 0
    while before != (before := sum(map(len, known.values()))):
        for said in statements:
            if isinstance(said, Relation) and said.is_true and not said.is_abstract:
                _narrow(known, said, world)
    return {name: [each for each in candidates[name] if each in known[name]] for name in candidates}


def _narrow(known: dict[str, set[str]], said: Relation, world: World) -> None:
    """Keep only related candidates."""
    if said.subject not in known or said.object not in known:
        return
    subjects, objects = known[said.subject], known[said.object]
    pairs = [
        (subject, other)
        for subject in subjects
        for other in world.related(subject, said.relation)
        if other in objects
    ]
    known[said.subject] = {subject for subject, _ in pairs}
    known[said.object] = {other for _, other in pairs}


@dataclass(frozen=True)
class _Search:
    """A search with backtracking. Each condition is tested as soon as all its parameters have a
    value.
    """

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
        for individual in self.candidates[name]:
            bound[name] = individual
            if all(holds(each, bound, self.world) for each in asked):
                yield from self.solutions(bound, depth + 1)
        bound.pop(name, None)

    def _is_decided_by(self, statement: Statement, name: str, bound: Mapping[str, str]) -> bool:
        about = names(statement)
        return name in about and all(each == name or each in bound for each in about)
