"""The search for a plan: PDDL through unified-planning, solved by Fast Downward.

All things are of one type, and classes are facts that never change: a class of OWL can have several
superclasses, a type of PDDL one. What follows from an effect, by inverses, special cases and
functional relations, is an effect as well.
"""

from __future__ import annotations

import contextlib
import io
import os
import tempfile
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ezskiros.engine.world import World
from ezskiros.planning.actions import Action
from ezskiros.planning.facts import EVERYTHING, About, Fluent, Literal, is_so, make_so

PLANNER = "fast-downward"


class NoPlannerError(Exception):
    """The planner is not installed; the text says how to install it."""

    def __init__(self) -> None:
        super().__init__("planning needs more packages: pip install 'rossmarie[plan]'")


class TimeOverError(Exception):
    """It took too long."""


@dataclass(frozen=True)
class Step:
    """A skill with the things that its parameters stand for, as IRIs."""

    action: Action
    things: Mapping[str, str]


def solve(
    actions: Sequence[Action],
    goals: Sequence[Literal],
    world: World,
    things: Sequence[str],
    seconds: float,
) -> list[Step] | None:
    """A plan; None if there is none. Raises `NoPlannerError` and `TimeOverError`."""
    try:
        import unified_planning.shortcuts as up
        import up_fast_downward  # noqa: F401 - asked for by name below
    except ImportError:
        raise NoPlannerError from None
    up.get_environment().credits_stream = None
    problem = _Problem(up, actions, things)
    problem.start(world)
    for goal in goals:
        problem.problem.add_goal(problem.expression(goal, {}))
    with (
        warnings.catch_warnings(),
        contextlib.redirect_stdout(io.StringIO()),
        _folder_of_its_own(),
    ):
        warnings.simplefilter("ignore")
        with up.OneshotPlanner(name=PLANNER) as planner:
            result = planner.solve(problem.problem, timeout=seconds)
    if result.plan is not None:
        return [problem.step(each) for each in result.plan.actions]
    if result.status.name in ("UNSOLVABLE_PROVEN", "UNSOLVABLE_INCOMPLETELY"):
        return None
    if result.status.name == "TIMEOUT":
        raise TimeOverError
    raise RuntimeError(f"the planner ended with {result.status.name}: {result.log_messages}")


@contextlib.contextmanager
def _folder_of_its_own() -> Iterator[None]:
    """Fast Downward writes `output.sas` where it is; two in one folder read each other's."""
    here = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            yield
        finally:
            os.chdir(here)


@dataclass
class _Problem:
    """A problem of unified-planning, with our names for what is in it."""

    up: Any
    actions: Sequence[Action]
    things: Sequence[str]
    problem: Any = None
    _fluents: dict[Fluent, Any] = field(default_factory=dict)
    _objects: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.problem = self.up.Problem("plan")
        self._type = self.up.UserType("thing")
        for number, iri in enumerate(self.things):
            self._objects[iri] = self.up.Object(f"thing_{number}", self._type)
        self.problem.add_objects(self._objects.values())
        for number, action in enumerate(self.actions):
            self.problem.add_action(self._action(f"skill_{number}", action))

    def start(self, world: World) -> None:
        """What is so in a world is so at the start."""
        for fluent in list(self._fluents):
            for arguments in self._tuples(fluent):
                if is_so(Literal(fluent, arguments), world):
                    called = self._fluents[fluent](*map(self._objects.__getitem__, arguments))
                    self.problem.set_initial_value(called, True)

    def _tuples(self, fluent: Fluent) -> Iterator[tuple[str, ...]]:
        for one in self.things:
            if fluent.about is not About.RELATION:
                yield (one,)
                continue
            yield from ((one, other) for other in self.things)

    def expression(self, literal: Literal, names: Mapping[str, Any]) -> Any:
        """A literal as unified-planning has it; `names` are parameters."""
        ends = (names.get(each) or self._objects[each] for each in literal.arguments)
        found = self._fluent(literal.fluent)(*ends)
        return found if literal.is_true else self.up.Not(found)

    def _fluent(self, fluent: Fluent) -> Any:
        if fluent not in self._fluents:
            count = 2 if fluent.about is About.RELATION else 1
            parameters = {f"thing_{number}": self._type for number in range(count)}
            made = self.up.Fluent(f"fact_{len(self._fluents)}", self.up.BoolType(), **parameters)
            self.problem.add_fluent(made, default_initial_value=False)
            self._fluents[fluent] = made
        return self._fluents[fluent]

    def _action(self, name: str, action: Action) -> Any:
        parameters = {each.name: self._type for each in action.things}
        made = self.up.InstantaneousAction(name, **parameters)
        names = {each.name: made.parameter(each.name) for each in action.things}
        for clause in action.needs:
            made.add_precondition(self.up.Or(*(self.expression(e, names) for e in clause)))
        for one, other in action.apart:
            made.add_precondition(self.up.Not(self.up.Equals(names[one], names[other])))
        for effect in action.effects:
            if EVERYTHING in effect.arguments:
                self._push_out(made, action, effect, names)
            else:
                fluent = self.expression(effect if effect.is_true else effect.negated(), names)
                made.add_effect(fluent, effect.is_true)
        return made

    def _push_out(
        self, made: Any, action: Action, effect: Literal, names: Mapping[str, Any]
    ) -> None:
        """The old value of a functional relation goes, the new one stays."""
        other = self.up.Variable("other", self._type)
        free = effect.arguments.index(EVERYTHING)
        kept = [
            names[each.arguments[free]]
            for each in action.effects
            if each.is_true
            and each.fluent == effect.fluent
            and each.arguments[1 - free] == effect.arguments[1 - free]
        ]
        differs = [self.up.Not(self.up.Equals(other, each)) for each in kept]
        fluent = self.expression(effect.negated(), {**names, EVERYTHING: other})
        made.add_effect(fluent, False, self.up.And(*differs), forall=[other])

    def step(self, instance: Any) -> Step:
        """A step of a plan in our names."""
        action = self.actions[int(instance.action.name.rpartition("_")[2])]
        iris = {made.name: iri for iri, made in self._objects.items()}
        given = (iris[str(each)] for each in instance.actual_parameters)
        names = (each.name for each in action.things)
        return Step(action, dict(zip(names, given, strict=True)))


# --- trying a plan out ----------------------------------------------------------------------------


@dataclass(frozen=True)
class Failed:
    """A step of a plan that cannot be made, and what it needs. After the last one: the goal."""

    number: int
    needed: Literal


def tried(steps: Sequence[Step], goals: Sequence[Literal], world: World) -> Failed | None:
    """Where a plan fails in a world model, which is changed; None if it leads to the goals."""
    for number, step in enumerate(steps, 1):
        lacking = _done(step, world)
        if lacking is not None:
            return Failed(number, lacking)
    return next((Failed(len(steps) + 1, each) for each in goals if not is_so(each, world)), None)


def shortened(
    steps: Sequence[Step], goals: Sequence[Literal], start: Callable[[], World]
) -> Sequence[Step]:
    """A plan without steps that need not be: a planner that takes the first plan that it finds may
    make detours. Each step is left out in turn, with those that cannot be made without it (greedy
    action elimination: Nakhost and Müller, 2010).
    """
    number = 0
    while number < len(steps):
        world = start()
        others = (*steps[:number], *steps[number + 1 :])
        kept = [each for each in others if _done(each, world) is None]
        if all(is_so(each, world) for each in goals):
            steps = kept
        else:
            number += 1
    return steps


def _done(step: Step, world: World) -> Literal | None:
    """Make a step in a world model; what is lacking if that cannot be: then nothing is changed."""
    things = dict(step.things)
    for clause in step.action.needs:
        bound = [each.bound(things) for each in clause]
        if not any(is_so(each, world) for each in bound):
            return bound[0]
    for effect in sorted(step.action.asserted, key=lambda each: each.is_true):
        make_so(effect.bound(things), world)
    return None
