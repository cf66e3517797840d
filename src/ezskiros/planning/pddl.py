"""A planning problem in PDDL, and the plan that a planner found for it.

All individuals have one type, and classes are facts that never change, because an OWL class can
have several superclasses, but a PDDL type only one. The consequences of an effect, by inverses,
special cases and functional relations, are effects as well. Names are numbers, because PDDL does
not distinguish `a` from `A`. An action with several prices is written once for each price, with
constant facts that select the individuals.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from ezskiros.engine.world import World
from ezskiros.learning.lessons import Cost
from ezskiros.planning.actions import PlanningAction
from ezskiros.planning.facts import EVERYTHING, About, Fluent, FluentLiteral, is_so
from ezskiros.planning.prices import Price, Prices, prices

_REQUIREMENTS = (
    ":strips", ":typing", ":equality", ":negative-preconditions", ":disjunctive-preconditions",
    ":conditional-effects", ":universal-preconditions", ":action-costs",
)  # fmt: skip


@dataclass(frozen=True)
class PlanStep:
    """A skill with the individuals of its parameters, as IRIs."""

    action: PlanningAction
    individuals: Mapping[str, str]


@dataclass(frozen=True)
class Problem:
    """Goals of a world, and the actions that may lead to them."""

    actions: Sequence[PlanningAction]
    goals: Sequence[FluentLiteral]
    world: World
    individuals: Sequence[str]
    costs: Sequence[Cost] = ()
    """The time that skills lose to rules. Without costs, all plans are equally good."""

    def domain(self) -> str:
        """The file of the domain: facts and actions."""
        arities = {name: _arity(fluent) for fluent, name in self._fluents.items()}
        arities |= {name: len(price.parameters) for name, _, price in self._priced()}
        predicates = [
            f"({name} {_typed(f'?individual_{number}' for number in range(arity))})"
            for name, arity in arities.items()
        ]
        actions = [each for number in range(len(self.actions)) for each in self._variants(number)]
        parts = (
            f"(:requirements {' '.join(_REQUIREMENTS)})",
            "(:types individual)",
            f"(:predicates {' '.join(predicates)})",
            *(("(:functions (total-cost) - number)",) if self.costs else ()),
            *actions,
        )
        return "\n".join(("(define (domain skills)", *parts, ")\n"))

    def problem(self) -> str:
        """The file of the problem: individuals, initial facts, and goals."""
        parts = (
            "(:domain skills)",
            f"(:objects {_typed(self._objects.values())})",
            f"(:init {' '.join((*self._so_at_the_start(), *self._prices_at_the_start()))})",
            f"(:goal {_all(self._literal(each, self._objects) for each in self.goals)})",
            *(("(:metric minimize (total-cost))",) if self.costs else ()),
        )
        return "\n".join(("(define (problem plan)", *parts, ")\n"))

    def steps(self, plan: str) -> list[PlanStep]:
        """The steps of a plan in a planner's format: one `(skill_0 individual_1 individual_2)`
        per line.
        """
        iris = {name: iri for iri, name in self._objects.items()}
        lines = [line.split(";")[0].strip("() \r") for line in plan.splitlines()]
        return [self._step(*line.split(), iris=iris) for line in lines if line]

    def _step(self, name: str, *given: str, iris: Mapping[str, str]) -> PlanStep:
        action = self.actions[int(name.split("_")[1])]
        names = (each.name for each in action.individuals)
        return PlanStep(action, dict(zip(names, (iris[each] for each in given), strict=True)))

    @cached_property
    def _objects(self) -> Mapping[str, str]:
        return {iri: f"individual_{number}" for number, iri in enumerate(self.individuals)}

    @cached_property
    def _fluents(self) -> Mapping[Fluent, str]:
        """All fluents of actions and goals."""
        of_actions = (
            each
            for action in self.actions
            for each in (*itertools.chain(*action.needs), *action.effects)
        )
        about = dict.fromkeys(each.fluent for each in (*of_actions, *self.goals))
        return {fluent: f"fact_{number}" for number, fluent in enumerate(about)}

    def _so_at_the_start(self) -> Iterator[str]:
        for fluent in self._fluents:
            for arguments in itertools.product(self.individuals, repeat=_arity(fluent)):
                literal = FluentLiteral(fluent, arguments)
                if is_so(literal, self.world):
                    yield self._literal(literal, self._objects)

    def _literal(self, literal: FluentLiteral, names: Mapping[str, str]) -> str:
        """A literal; `names` are the names of individuals and parameters."""
        ends = (names.get(each) or self._objects[each] for each in literal.arguments)
        fact = f"({self._fluents[literal.fluent]} {' '.join(ends)})"
        return fact if literal.is_true else _not(fact)

    @cached_property
    def _prices(self) -> Sequence[Prices]:
        return [prices(each, self.costs) for each in self.actions]

    def _priced(self) -> Iterator[tuple[str, int, Price]]:
        """The prices at places: the name of the fact, the number of the action, the price."""
        for number, found in enumerate(self._prices):
            for index, price in enumerate(found.at_places):
                yield f"priced_{number}_{index}", number, price

    def _prices_at_the_start(self) -> Iterator[str]:
        if self.costs:
            yield "(= (total-cost) 0)"
        for name, _, price in self._priced():
            for individuals in price.individuals:
                if all(each in self._objects for each in individuals):
                    yield f"({name} {' '.join(self._objects[each] for each in individuals)})"

    def _variants(self, number: int) -> Iterator[str]:
        """An action, once for each of its prices."""
        action = self.actions[number]
        names = {each.name: f"?given_{index}" for index, each in enumerate(action.individuals)}
        elsewhere = []
        for fact, other, price in self._priced():
            if other == number:
                so = f"({fact} {' '.join(names[each] for each in price.parameters)})"
                elsewhere.append(_not(so))
                yield self._action(f"skill_{number}_{fact}", action, names, [so], price.cost)
        usual = self._prices[number].usual
        yield self._action(f"skill_{number}", action, names, elsewhere, usual)

    def _action(
        self,
        name: str,
        action: PlanningAction,
        names: Mapping[str, str],
        where: Iterable[str],
        cost: int,
    ) -> str:
        needs = [
            f"(or {' '.join(self._literal(each, names) for each in clause)})"
            for clause in action.needs
        ]
        apart = [_not(f"(= {names[one]} {names[other]})") for one, other in action.apart]
        effects = [self._effect(action, each, names) for each in action.effects]
        if self.costs:
            effects.append(f"(increase (total-cost) {cost})")
        return (
            f"(:action {name} :parameters ({_typed(names.values())})"
            f"\n :precondition {_all((*needs, *apart, *where))}\n :effect {_all(effects)})"
        )

    def _effect(
        self, action: PlanningAction, effect: FluentLiteral, names: Mapping[str, str]
    ) -> str:
        """An effect. For a functional relation, the old value is removed and the new one stays."""
        if EVERYTHING not in effect.arguments:
            return self._literal(effect, names)
        free = effect.arguments.index(EVERYTHING)
        differs = [
            _not(f"(= ?other {names[each.arguments[free]]})")
            for each in action.effects
            if each.is_true
            and each.fluent == effect.fluent
            and each.arguments[1 - free] == effect.arguments[1 - free]
        ]
        gone = self._literal(effect, {**names, EVERYTHING: "?other"})
        return f"(forall (?other - individual) (when {_all(differs)} {gone}))"


def _arity(fluent: Fluent) -> int:
    return 2 if fluent.about is About.RELATION else 1


def _typed(names: Iterable[str]) -> str:
    return " ".join(f"{name} - individual" for name in names)


def _not(fact: str) -> str:
    return f"(not {fact})"


def _all(facts: Iterable[str]) -> str:
    return f"(and {' '.join(facts)})"
