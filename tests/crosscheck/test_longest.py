"""The longest times of trees, compared with trees that the engine ticks in all ways."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from crosscheck import longest
from crosscheck.longest import STEP, Longest
from ezskiros.engine import processors
from ezskiros.session import NOWHERE
from ezskiros.skills.nodes import Decoration, Decorator, Flow
from support.depth import examples

Tree = tuple[Any, ...]
"""A tree: `("step",)`, or a kind, its limit, and what is below."""
LATE = 40.0
"""The time of a step that nothing bounds, longer than all deadlines together."""
ENDS = [(s, end) for s in (0.0, 1.0, 2.0, LATE) for end in (Status.SUCCESS, Status.FAILURE)]
OF_MANY: dict[str, tuple[Callable[[list[Longest]], Longest], Flow]] = {
    "serial": (longest.in_turn, Flow.SERIAL_STAR),
    "selector": (longest.until_one, Flow.SELECTOR_STAR),
    "nofail": (longest.never_failing, Flow.NO_FAIL),
    "parallelff": (longest.at_once, Flow.PARALLEL_FF),
    "parallelfs": (longest.until_first, Flow.PARALLEL_FS),
}
STEPS: Tree = ("step",)


def times(tree: Tree) -> Longest:
    kind, *rest = tree
    below = [times(each) for each in rest[1:]]
    if kind == "step":
        return STEP
    if kind == "timeout":
        return longest.within(rest[0], below[0], "it")
    if kind == "retry":
        return longest.again(rest[0], below[0], "it")
    return longest.turned(below[0]) if kind == "inverter" else OF_MANY[kind][0](below)


# --- the engine ----------------------------------------------------------------------------------


@dataclass
class World:
    """A clock, and the ends that steps choose, one after the other."""

    chosen: list[int]
    now: float = 0.0
    started: int = 0
    setting: Any = field(init=False)

    def __post_init__(self) -> None:
        self.setting = SimpleNamespace(clock=lambda: self.now, last_failure=None)

    def choose(self) -> tuple[float, Status]:
        if self.started == len(self.chosen):
            self.chosen.append(0)
        self.started += 1
        return ENDS[self.chosen[self.started - 1]]


class Step(Behaviour):
    """Takes the time that it chooses."""

    def __init__(self, world: World) -> None:
        super().__init__("step")
        self._world = world

    def initialise(self) -> None:
        seconds, self._result = self._world.choose()
        self.end = self._world.now + seconds

    def update(self) -> Status:
        return self._result if self._world.now >= self.end else Status.RUNNING


def made(tree: Tree, world: World) -> Behaviour:
    kind, *rest = tree
    if kind == "step":
        return Step(world)
    below = [made(each, world) for each in rest[1:]]
    if kind in OF_MANY:
        return processors.processor(OF_MANY[kind][1], below)
    node = Decorator(Decoration(kind.capitalize()), None, rest[0], NOWHERE)  # type: ignore[arg-type]
    return processors.decorator(node, below[0], world.setting)


def ended(tree: Tree, world: World) -> tuple[Status, float]:
    """The result of a tree, and when it comes. Ticks need no time."""
    root = made(tree, world)
    while True:
        for _ in range(_AT_AN_INSTANT):
            for _ in root.tick():
                pass
            if root.status is not Status.RUNNING:
                return root.status, world.now
        world.now = min(each for each in _ends(root) if each > world.now)


_AT_AN_INSTANT = 5
"""The ticks at one instant: a retry starts its child at the next one."""


def _ends(root: Behaviour) -> Iterator[float]:
    for each in root.iterate():
        if each.status is Status.RUNNING:
            yield from (getattr(each, name) for name in ("end", "_end") if hasattr(each, name))


def on_all_paths(tree: Tree) -> dict[Status, float]:
    """The last instant at which each result comes."""
    latest: dict[Status, float] = {}
    chosen: list[int] | None = []
    runs = 0
    while chosen is not None:
        runs += 1
        assume(runs < _MOST_RUNS)
        world = World(chosen)
        status, at = ended(tree, world)
        latest[status] = max(latest.get(status, 0.0), at)
        del world.chosen[world.started :]
        chosen = following(world.chosen)
    return latest


_MOST_RUNS = 6000


def following(chosen: list[int]) -> list[int] | None:
    """The next choices in their order; None behind the last."""
    while chosen and chosen[-1] == len(ENDS) - 1:
        chosen.pop()
    return [*chosen[:-1], chosen[-1] + 1] if chosen else None


# --- both ----------------------------------------------------------------------------------------

TREES = st.recursive(
    st.sampled_from([STEPS, ("timeout", 1.0, STEPS), ("timeout", 2.0, STEPS)]),
    lambda inner: st.one_of(
        st.tuples(st.just("timeout"), st.sampled_from([1.0, 2.0]), inner),
        st.tuples(st.just("retry"), st.just(2), inner),
        st.tuples(st.just("inverter"), st.none(), inner),
        st.lists(inner, min_size=1, max_size=3).flatmap(
            lambda below: st.sampled_from([*OF_MANY]).map(lambda kind: (kind, None, *below))
        ),
    ),
    max_leaves=3,
)


@given(TREES)
@settings(max_examples=examples(3), deadline=None)
def test_no_tree_takes_longer(tree: Tree) -> None:
    """Without nodes that tick side by side, one takes as long. With these, of two that end at the
    same instant the first decides, so that the longest time is only approached.
    """
    reported, seen = times(tree), on_all_paths(tree)
    has_beside = "parallel" in str(tree)
    for status, time in ((Status.SUCCESS, reported.success), (Status.FAILURE, reported.failure)):
        found = seen.get(status)
        assert (found is None) or (time is not None and found <= time.seconds), (reported, seen)
        if not has_beside:
            assert (time is None) == (found is None), (reported, seen)
            assert time is None or found == time.seconds or _is_endless(found, time.seconds)
    for each in (reported.success, reported.failure):
        if each is not None and math.isfinite(each.seconds):
            assert sum(seconds for _, seconds in each.parts) == each.seconds


def _is_endless(found: float | None, seconds: float) -> bool:
    return seconds == math.inf and found is not None and found >= LATE


def timed(seconds: float) -> Tree:
    return ("timeout", seconds, STEPS)


@pytest.mark.parametrize(
    ("tree", "success", "failure"),
    [
        (STEPS, math.inf, math.inf),
        (("serial", None, timed(2), timed(1)), 3, 3),
        (("selector", None, timed(2), timed(1)), 3, 3),
        (("parallelff", None, timed(2), timed(1)), 2, 2),
        (("parallelfs", None, timed(2), timed(1)), 1, 1),
        (("nofail", None, timed(2)), 2, None),
        (("serial", None, ("nofail", None, timed(2)), timed(1)), 3, 3),
        (("selector", None, ("nofail", None, timed(2)), timed(1)), 2, None),
        (("retry", 3, timed(2)), 6, 6),
        (("retry", 3, ("nofail", None, timed(2))), 2, None),
        (("timeout", 3, ("retry", 3, timed(2))), 3, 3),
        (("timeout", 9, ("retry", 3, timed(2))), 6, 6),
        (("inverter", None, ("nofail", None, timed(2))), None, 2),
        (("parallelff", None, ("inverter", None, ("nofail", None, timed(1))), STEPS), None, 1),
        (("serial", None), 0, None),
    ],
)
def test_longest_times(tree: Tree, success: float | None, failure: float | None) -> None:
    reported = times(tree)
    assert (reported.success and reported.success.seconds) == success
    assert (reported.failure and reported.failure.seconds) == failure
