"""Runs of random trees in small worlds, with choices made by chance.

A child that can start finds individuals for its inferred parameters, and then succeeds, fails, or
fails half way; one that is stopped has done some of its work, too. What it makes so pushes out of
the world what cannot stay, and nothing else. What starts again in a later tick ends in this tick.
"""

from __future__ import annotations

import random
from collections.abc import Generator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product

from ezskiros.ontology.statements import AnyOf, Relation
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import Clause, SkillInterface
from ezskiros.skills.markers import ParameterKind
from ezskiros.skills.nodes import Decoration, Decorator, Flow, Node, Processor
from ezskiros.trees.tree import IndividualReference
from support.contract_trees import INDIVIDUALS, OWN, RELATIONS, Drawn, Facts, holds
from support.ontologies import START

Ticks = Generator[None, None, bool]


def ticked(running: Ticks) -> bool | None:
    """The result of what runs; None if it goes on."""
    try:
        next(running)
    except StopIteration as end:
        return bool(end.value)
    return None


@dataclass(frozen=True)
class Place:
    """The position of a node: in a further try of a retry, in a part that a later tick restarts, or
    before a fallback.
    """

    is_retried: bool = False
    is_again: bool = False
    is_spared: bool = False


@dataclass
class Run:
    """One run of a tree, with choices made by chance."""

    drawn: Drawn
    facts: set[tuple[str, int, int]]
    chance: random.Random
    names: dict[str, int] = field(default_factory=lambda: dict(OWN))
    false_starts: list[tuple[SkillCall, bool]] = field(default_factory=list)
    """Children that could not start, and whether that need not be reported: a retry had started
    them, or a later tick where others stand in.
    """
    started: list[SkillCall] = field(default_factory=list)
    broken_holds: list[Clause] = field(default_factory=list)
    """The false hold-conditions of the compound skill when a child started. Those that a further
    try ends are not reported.
    """
    is_broken: bool = False
    """True if the compound skill would have failed because of a hold-condition."""

    @property
    def world(self) -> Facts:
        return self.drawn.rules.closed(self.facts)

    def run(self, node: Node, place: Place = Place()) -> Ticks:
        """Run a node. Yield between ticks, and return whether the node succeeded."""
        match node:
            case SkillCall():
                return (yield from self._call(node, place))
            case Decorator(decoration=Decoration.INVERTER, child=child):
                return not (yield from self.run(child, replace(place, is_spared=True)))
            case Decorator(decoration=Decoration.TIMEOUT, child=child):
                return (yield from self._timed(child, place))
            case Decorator(child=child):
                return (yield from self._retried(child, place))
            case Processor(flow=flow, children=below):
                return (yield from self._processed(flow, below, place))

    def _processed(self, flow: Flow, below: Sequence[Node], place: Place) -> Ticks:
        spared = replace(place, is_spared=True)
        match flow:
            case Flow.SERIAL | Flow.SERIAL_STAR:
                is_star = flow is Flow.SERIAL_STAR
                return (yield from self._in_turn(below, place, while_is=True, is_star=is_star))
            case Flow.SELECTOR | Flow.SELECTOR_STAR:
                is_star = flow is Flow.SELECTOR_STAR
                inner = spared if len(below) > 1 else place
                return (yield from self._in_turn(below, inner, while_is=False, is_star=is_star))
            case Flow.NO_FAIL:
                yield from self._in_turn(below, spared, while_is=True, is_star=True)
                return True
            case Flow.PARALLEL_FF | Flow.PARALLEL_FS:
                is_race = flow is Flow.PARALLEL_FS
                return (yield from self._parallel(below, place, is_race=is_race))

    def _in_turn(
        self, below: Sequence[Node], place: Place, *, while_is: bool, is_star: bool
    ) -> Ticks:
        """A serial goes on while children succeed, a selector while they fail; without a star each
        tick starts with the first.
        """
        for index, child in enumerate(below):
            running = self.run(child, place)
            while (result := ticked(running)) is None:
                yield
                for before in () if is_star else below[:index]:
                    if self._again(before, place) is not while_is:
                        running.close()
                        return not while_is
            if result is not while_is:
                return result
        return while_is

    def _again(self, node: Node, place: Place) -> bool:
        """The result of what a later tick starts again."""
        running = self.run(node, replace(place, is_again=True))
        while (result := ticked(running)) is None:
            pass
        return result

    def _timed(self, child: Node, place: Place) -> Ticks:
        running = self.run(child, place)
        while (result := ticked(running)) is None:
            if self.chance.random() < 0.2:
                running.close()
                return False
            yield
        return result

    def _retried(self, child: Node, place: Place) -> Ticks:
        if (yield from self.run(child, place)):
            return True
        yield
        return (yield from self.run(child, replace(place, is_retried=True)))

    def _parallel(self, below: Sequence[Node], place: Place, *, is_race: bool) -> Ticks:
        running = [self.run(child, place) for child in below]
        while running:
            for each in list(running):
                result = ticked(each)
                if result is not None:
                    running.remove(each)
                    if not result or is_race:
                        for other in running:
                            other.close()
                        return result
                if self.chance.random() < 0.3:
                    yield
            yield
        return True

    # --- children

    def _call(self, call: SkillCall, place: Place) -> Ticks:
        for clause in self.drawn.compound.hold:
            if not holds(clause.statement, self.world, OWN):
                self.is_broken = True
                self.broken_holds += [] if place.is_retried else [clause]
        skill = self.drawn.skills.skill(call.skill)
        individuals = self._individuals(call, skill)
        if individuals is None:
            is_spared = place.is_again and place.is_spared
            self.false_starts.append((call, place.is_retried or is_spared))
            return False
        self.started.append(call)
        for parameter in skill.parameters:
            if parameter.kind is ParameterKind.INFERRED:
                self.names[parameter.name] = individuals[parameter.name]
        try:
            if not place.is_again and self.chance.random() < 0.5:
                yield
        except GeneratorExit:
            self._make_some(skill, individuals)
            raise
        if self.chance.random() < 0.25:
            self._make_some(skill, individuals)
            return False
        self._make(skill.post, individuals)
        return all(holds(each.statement, self.world, individuals) for each in skill.post)

    def _individuals(self, call: SkillCall, skill: SkillInterface) -> dict[str, int] | None:
        """Individuals for all parameters by which the child can start."""
        individuals = {
            name: self.names[given.parameter.name]
            for name, given in call.arguments.items()
            if isinstance(given, IndividualReference)
        }
        free = [
            each.name for each in skill.parameters if each.name not in individuals
            and each.name not in self.names
        ]  # fmt: skip
        individuals |= {
            each.name: self.names[each.name]
            for each in skill.parameters
            if each.name not in individuals and each.name not in free
        }
        choices = [*product(INDIVIDUALS, repeat=len(free))]
        self.chance.shuffle(choices)
        for choice in choices:
            found = {**individuals, **dict(zip(free, choice, strict=True))}
            if all(holds(each.statement, self.world, found) for each in (*skill.pre, *skill.hold)):
                return found
        return None

    def _make_some(self, skill: SkillInterface, individuals: Mapping[str, int]) -> None:
        self._make([each for each in skill.post if self.chance.random() < 0.5], individuals)

    def _make(self, clauses: Sequence[Clause], individuals: Mapping[str, int]) -> None:
        """Make conditions hold, and keep all else that can stay."""
        wanted: set[tuple[str, int, int]] = set()
        for clause in clauses:
            said = clause.statement
            if isinstance(said, AnyOf):
                if holds(said, self.world, individuals):
                    continue
                said = self.chance.choice(said.parts)
            assert isinstance(said, Relation)
            if said.is_true:
                name = said.relation.removeprefix(START)
                wanted.add((name, individuals[said.subject], individuals[said.object]))
        rules = self.drawn.rules

        def is_fine(facts: set[tuple[str, int, int]]) -> bool:
            world = rules.closed(facts)
            return rules.is_possible(world) and all(
                holds(each.statement, world, individuals)
                for each in clauses
                if isinstance(each.statement, Relation) and not each.statement.is_true
            )

        if not is_fine(wanted):
            return
        kept = sorted(self.facts)
        self.chance.shuffle(kept)
        for fact in kept:
            if is_fine({*wanted, fact}):
                wanted.add(fact)
        self.facts = wanted


def start(drawn: Drawn, chance: random.Random) -> set[tuple[str, int, int]] | None:
    """A world in which what the compound needs is so; None if none is found."""
    for _ in range(30):
        facts: set[tuple[str, int, int]] = set()
        run = Run(drawn, facts, chance)
        said = [*drawn.compound.pre, *drawn.compound.hold]
        run._make(said, OWN)
        for name, one, other in product(RELATIONS, INDIVIDUALS, INDIVIDUALS):
            more = {*run.facts, (name, one, other)}
            world = drawn.rules.closed(more)
            is_wanted = all(holds(each.statement, world, OWN) for each in said)
            if drawn.rules.is_possible(world) and is_wanted and chance.random() < 0.25:
                run.facts = more
        if all(holds(each.statement, run.world, OWN) for each in said):
            return run.facts
    return None


def finished(run: Run) -> bool:
    running = run.run(run.drawn.root)
    while (result := ticked(running)) is None:
        pass
    return result
