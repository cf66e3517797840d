"""Reasons why a goal is unreachable: facts that no skill achieves and the scene does not have.

The method is delete relaxation: a fact that was once possible stays possible, and so does its
negation. A fact that is impossible even then is unreachable. Actions are tried with all individuals
that their needs allow, until no new fact becomes possible.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from ezskiros.engine.world import World
from ezskiros.planning.actions import PlanningAction
from ezskiros.planning.facts import EVERYTHING, About, Clause, FluentLiteral, is_so


@dataclass(frozen=True)
class MissingFact:
    """The missing part of a goal: a fact that no skill achieves."""

    literal: FluentLiteral
    chain: tuple[tuple[str, FluentLiteral], ...] = ()
    """The skills that would help, each with its missing need, the last skill first."""
    without: str | None = None
    """The class without members: the last skill needs an individual of this class."""
    circular: tuple[str, ...] = ()
    """Skills that achieve the fact but need it themselves, or need a fact that depends on it."""


class ReachTimeOverError(Exception):
    """The search took too long."""


@dataclass
class ReachableFacts:
    """The possible facts of a world, given some actions, until a time of `time.monotonic`."""

    world: World
    individuals: Sequence[str]
    actions: Sequence[PlanningAction]
    until: float
    _new: dict[FluentLiteral, None] = field(default_factory=dict)
    """The facts that were false at the start and have become possible."""
    _initially: dict[FluentLiteral, bool] = field(default_factory=dict)

    def __post_init__(self) -> None:
        count = -1
        while count < len(self._new):
            count = len(self._new)
            for action in self.actions:
                for bound in self.bindings(action):
                    for effect in action.effects:
                        self._new.update(dict.fromkeys(self._grounded(effect.bound(bound))))

    def is_possible(self, literal: FluentLiteral) -> bool:
        """Say whether a fact can become true."""
        return literal in self._new or self._is_initially(literal)

    def leads_on(self, action: PlanningAction, bound: dict[str, str]) -> bool:
        """Say whether an action with these individuals makes a new fact possible."""
        effects = (each for e in action.effects for each in self._grounded(e.bound(bound)))
        return not all(map(self.is_possible, effects))

    def missing(
        self, goal: FluentLiteral, seen: frozenset[FluentLiteral] = frozenset()
    ) -> MissingFact:
        """Find the missing facts behind an impossible fact."""
        best: MissingFact | None = None
        circular: list[str] = []
        for action in self.actions:
            for effect in action.effects:
                bound = _matched(effect, goal)
                lacking = None if bound is None else self._lacking(action, bound, goal)
                if lacking is None:
                    continue
                if isinstance(lacking, FluentLiteral) and lacking in seen | {goal}:
                    circular.append(action.skill.name)
                    continue
                found = self._below(action, lacking, goal, seen | {goal})
                if best is None or len(found.chain) < len(best.chain):
                    best = found
        return best or MissingFact(goal, circular=tuple(dict.fromkeys(circular)))

    def _below(
        self,
        action: PlanningAction,
        lacking: FluentLiteral | str,
        goal: FluentLiteral,
        seen: frozenset[FluentLiteral],
    ) -> MissingFact:
        """Find the missing facts behind a missing need of an action: a fact, or an individual of a
        class.
        """
        if isinstance(lacking, str):
            return MissingFact(goal, ((action.skill.name, goal),), lacking)
        found = self.missing(lacking, seen)
        return replace(found, chain=(*found.chain, (action.skill.name, lacking)))

    def _lacking(
        self, action: PlanningAction, bound: dict[str, str], goal: FluentLiteral
    ) -> FluentLiteral | str | None:
        """One of the impossible needs, for the individuals with the fewest of them, or a class
        without individuals. None if the action does not affect the goal.
        """
        for parameter in action.individuals:
            if parameter.name not in bound and not self._candidates(parameter.iri or ""):
                return parameter.iri
        for spare in range(1, len(action.needs) + 1):
            individuals = next(self._bindings(action, bound, spare), None)
            if individuals is not None:
                needs = (tuple(e.bound(individuals) for e in clause) for clause in action.needs)
                lacking = [each[0] for each in needs if not any(map(self.is_possible, each))]
                return next((each for each in lacking if each != goal), lacking[0])
        return None

    # --- assignments ------------------------------------------------------------------------------

    def bindings(self, action: PlanningAction) -> Iterator[dict[str, str]]:
        """The individuals for which all needs of an action are possible."""
        return self._bindings(action, {}, 0)

    def _bindings(
        self, action: PlanningAction, bound: dict[str, str], spare: int
    ) -> Iterator[dict[str, str]]:
        """The individuals of the parameters for which all needs are possible, except `spare` of
        them. Classes are always required.
        """
        decided = [e for e in action.needs if _names(e) <= bound.keys()]
        left = self._left(decided, bound, spare)
        if left is not None:
            yield from self._extended(action, dict(bound), left)

    def _extended(
        self, action: PlanningAction, bound: dict[str, str], spare: int
    ) -> Iterator[dict[str, str]]:
        if time.monotonic() > self.until:
            raise ReachTimeOverError
        free = [each for each in action.individuals if each.name not in bound]
        if not free:
            yield dict(bound)
            return
        parameter = min(free, key=lambda each: len(self._candidates(each.iri or "")))
        name = parameter.name
        for individual in self._candidates(parameter.iri or ""):
            bound[name] = individual
            if self._are_apart(action, bound, name):
                decided = [each for each in action.needs if name in _names(each) <= bound.keys()]
                left = self._left(decided, bound, spare)
                if left is not None:
                    yield from self._extended(action, bound, left)
            del bound[name]

    def _left(self, needs: Sequence[Clause], bound: dict[str, str], spare: int) -> int | None:
        """The number of needs that may still be impossible; None if too many are."""
        for clause in needs:
            if not any(self.is_possible(each.bound(bound)) for each in clause):
                spare -= 1
                if spare < 0 or clause[0].fluent.about is About.CLASS:
                    return None
        return spare

    def _candidates(self, owl_class: str) -> list[str]:
        if owl_class not in self._of_class:
            self._of_class[owl_class] = self.world.individuals(owl_class)
        return self._of_class[owl_class]

    _of_class: dict[str, list[str]] = field(default_factory=dict)

    def _are_apart(self, action: PlanningAction, bound: Mapping[str, str], name: str) -> bool:
        pairs = (pair for pair in action.apart if name in pair)
        return all(bound.get(one) != bound.get(other) for one, other in pairs)

    def _is_initially(self, literal: FluentLiteral) -> bool:
        if literal not in self._initially:
            self._initially[literal] = is_so(literal, self.world)
        return self._initially[literal]

    def _grounded(self, effect: FluentLiteral) -> Iterator[FluentLiteral]:
        """An effect for each individual, if it is about all of them."""
        if EVERYTHING not in effect.arguments:
            yield effect
            return
        for individual in self.individuals:
            yield effect.bound({EVERYTHING: individual})


def _names(clause: Clause) -> set[str]:
    return {each for literal in clause for each in literal.arguments}


def _matched(effect: FluentLiteral, goal: FluentLiteral) -> dict[str, str] | None:
    """The individuals of the parameters with which an effect is the goal; None if it never is."""
    if effect.fluent != goal.fluent or effect.is_true != goal.is_true:
        return None
    found: dict[str, str] = {}
    for name, individual in zip(effect.arguments, goal.arguments, strict=True):
        if name != EVERYTHING and found.setdefault(name, individual) != individual:
            return None
    return found
