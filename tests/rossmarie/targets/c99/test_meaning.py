"""The generated C against the interpreter where random machines rarely look.

One machine with everything in it runs over long traces of few different values, so that numbers
land exactly on limits, cross two limits at once, and timers fall due with messages.
"""

from __future__ import annotations

import random
from collections.abc import Iterator

import pytest

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, Comparison, FieldKind
from rossmarie.native import NativeMonitor, load_native
from rossmarie.targets.c99 import generate_loadable
from support.c_compiler import needs_c
from support.drafts import SECOND, Draft
from support.machines import Advance, Reset, Step, Update, observe

pytestmark = needs_c

TICK = SECOND // 10
STEPS = 1500


@pytest.fixture(autouse=True, scope="module")
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


def native(machine: ir.Machine) -> NativeMonitor:
    return load_native(machine, generate_loadable(machine))


def everything() -> ir.Machine:
    draft = Draft(texts=("docked", "driving"))
    first, second, third = (draft.channel() for _ in range(3))
    timed = draft.input(first, 5 * TICK)
    x = draft.signal(ir.Read(draft.slot(timed)))
    flag = draft.signal(ir.Read(draft.slot(timed, FieldKind.FLAG)))
    mode = draft.signal(ir.Read(draft.slot(timed, FieldKind.TEXT)))
    y = draft.signal(ir.Read(draft.slot(draft.input(second), scale=0.5, offset=0.25)))
    ranges = draft.signal(ir.Element(draft.array(draft.input(third, 9 * TICK))))
    rate = draft.signal(ir.Sampled(ir.Sampling.RATE, x))
    before = draft.signal(ir.Sampled(ir.Sampling.PREVIOUS, x))
    both = draft.apply(ir.Function.ADD, x, y)
    nearest = draft.signal(ir.Fold(ir.Folding.MINIMUM, ranges))
    near = draft.above(ranges, 1.0)
    one, two = draft.constant(1.0), draft.constant(2.0)
    held = draft.proposition(ir.Held(draft.above(x, 1.0), 3 * TICK), "held")
    conditions = [
        draft.proposition(ir.Between(x, one, two), "between"),
        draft.proposition(ir.Between(both, two, one), "never"),
        *(
            draft.proposition(ir.Compare(comparison, x, one), comparison.name)
            for comparison in Comparison
        ),
        draft.proposition(ir.Compare(Comparison.LESS_OR_EQUAL, two, x), "mirrored"),
        held,
        draft.proposition(ir.Held(draft.proposition(ir.Not(held)), 4 * TICK)),
        draft.proposition(ir.Flag(flag)),
        draft.proposition(ir.Compare(Comparison.EQUAL, mode, draft.constant(1.0))),
        draft.proposition(ir.Compare(Comparison.GREATER, x, before)),
        draft.above(rate, 5.0),
        draft.proposition(ir.Compare(Comparison.NOT_EQUAL, both, y)),
        draft.proposition(ir.AgeReaches(1, 7 * TICK)),
        draft.proposition(ir.AgeReaches(0, 3 * TICK)),
        draft.proposition(ir.Oscillates(x, 2, 8 * TICK, 0.0)),
        draft.proposition(ir.Oscillates(x, 3, 20 * TICK, 1.0)),
        draft.proposition(ir.Compare(Comparison.LESS, nearest, draft.constant(0.5))),
        draft.proposition(ir.Quantified(ir.Quantifier.ANY, near)),
        draft.proposition(ir.Quantified(ir.Quantifier.ALL, near)),
        draft.above(draft.signal(ir.Count(near)), 1.0),
    ]
    for number, condition in enumerate(conditions):
        release = conditions[number - 1] if number % 3 == 2 else None
        draft.rule(condition, release, latched=number % 3 == 1)
    together = draft.proposition(ir.And(tuple(conditions[:3])))
    draft.rule(draft.proposition(ir.Or((together, *conditions[10:]))))
    return draft.machine("everything")


def trace(seed: int) -> Iterator[Step]:
    chance = random.Random(seed)
    numbers = (0.0, 0.5, 1.0, 1.5, 2.0, 3.0, -0.0, float("nan"), float("inf"))
    weights = (9, 9, 9, 9, 9, 9, 2, 1, 1)
    at_ns = 0

    def number() -> float:
        return chance.choices(numbers, weights)[0]

    def message(channel: int) -> ChannelValues:
        if channel == 0:
            flag, mode = chance.choice((0.0, 1.0)), chance.choice((-1.0, 0.0, 1.0))
            return ChannelValues({0: number(), 1: flag, 2: mode})
        if channel == 1:
            return ChannelValues({3: number()})
        return ChannelValues({}, {0: [number() for _ in range(chance.randrange(4))]})

    for _ in range(STEPS):
        at_ns += chance.choices((0, TICK, 2 * TICK, 3 * TICK + 1, 12 * TICK, -5 * TICK),
                                (3, 12, 4, 3, 1, 0.2))[0]  # fmt: skip
        kind = chance.random()
        if kind < 0.05:
            yield Advance(at_ns)
        elif kind < 0.1:
            yield Reset(at_ns, chance.choice((None, 1, 4)))
        else:
            channels = chance.choice(([0], [0], [0], [1], [2], [0, 1], [0, 2], [0, 1, 2]))
            yield Update(at_ns, {channel: message(channel) for channel in channels})


@pytest.mark.parametrize("seed", range(6))
def test_everything_over_long_traces(seed: int) -> None:
    machine = everything()
    ir.verify(machine)
    steps = list(trace(seed))
    wanted = observe(Interpreter(machine), steps)
    found = observe(native(machine), steps)
    for number, (one, other) in enumerate(zip(found, wanted, strict=True)):
        assert one == other, f"step {number}: {steps[number]}"


def small() -> ir.Machine:
    """The same numbers with few enough conditions for a single word of marks."""
    draft = Draft()
    used = draft.input(draft.channel(), 5 * TICK)
    x = draft.signal(ir.Read(draft.slot(used)))
    one, two = draft.constant(1.0), draft.constant(2.0)
    between = draft.proposition(ir.Between(x, one, two))
    equal = draft.proposition(ir.Compare(Comparison.EQUAL, x, one))
    magnitude = draft.above(draft.apply(ir.Function.NEGATE, x), -1.5)
    held = draft.proposition(ir.Held(draft.proposition(ir.Not(equal)), 3 * TICK))
    draft.rule(draft.proposition(ir.And((held, magnitude))))
    draft.rule(between)
    draft.rule(equal, latched=True)
    return draft.machine("small")


@pytest.mark.parametrize("seed", range(4))
def test_few_conditions_over_long_traces(seed: int) -> None:
    machine = small()
    chance = random.Random(seed)
    steps: list[Step] = []
    at_ns = 0
    for _ in range(STEPS):
        at_ns += chance.choice((0, TICK, TICK, 2 * TICK, 6 * TICK))
        x = chance.choice((0.0, 0.5, 1.0, 1.5, 2.0, 3.0, float("nan"), float("-inf")))
        message = Update(at_ns, {0: ChannelValues({0: x})})
        steps.append(message if chance.random() < 0.9 else Advance(at_ns))
    assert observe(native(machine), steps) == observe(Interpreter(machine), steps)


def test_crossing_both_ends_of_an_interval_is_no_change() -> None:
    """Since when a proposition has its value is not touched when a number jumps over all of it."""
    machine = small()
    monitor = native(machine)
    monitor.update(0, {0: ChannelValues({0: 0.0})})
    for step, x in enumerate((3.0, 0.0, 3.0), start=1):
        assert monitor.update(step * TICK, {0: ChannelValues({0: x})}) == []
    (verdict,) = monitor.update(4 * TICK, {0: ChannelValues({0: 1.5})})
    assert isinstance(verdict, ir.Verdict)
    assert verdict.since_ns == (4 * TICK,)
