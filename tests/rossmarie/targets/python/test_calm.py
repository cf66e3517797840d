"""Long traces of messages of which most change nothing, over everything that is looked at then."""

from __future__ import annotations

import math
import random
from collections.abc import Callable

import pytest

from rossmarie import ir
from rossmarie.engines.python_monitor import PythonMonitor
from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, Comparison, Function
from rossmarie.targets.python import source
from support.drafts import SECOND, Draft
from support.machines import Update, observe
from support.runs import FastCalls

NUMBERS = (-2.0, -1.0, -0.5, -0.0, 0.0, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 3.0)
BROKEN = (math.nan, math.inf, -math.inf, 1e200, -1e308)


class Topics(Draft):
    """Two numbers of one topic, and one of another, which has a timeout."""

    def __init__(self) -> None:
        super().__init__()
        topic = self.input(self.channel())
        self.x, self.y = (self.signal(ir.Read(self.slot(topic))) for _ in range(2))
        self.z = self.read(SECOND)

    def greater(self, left: int, right: int) -> int:
        return self.proposition(ir.Compare(Comparison.GREATER, left, right))


def drafted(condition: Callable[[Topics], int]) -> ir.Machine:
    """A rule, and another one that needs the same for some time and is latched."""
    draft = Topics()
    draft.rule(condition(draft))
    draft.rule(draft.proposition(ir.Held(condition(draft), SECOND // 2)), latched=True)
    machine = draft.machine()
    ir.verify(machine)
    return machine


CONDITIONS: dict[str, Callable[[Topics], int]] = {
    "of one topic": lambda d: d.greater(d.x, d.y),
    "of two topics": lambda d: d.greater(d.x, d.z),
    "range": lambda d: d.proposition(ir.Between(d.x, d.y, d.z)),
    "sum": lambda d: d.above(d.apply(Function.ADD, d.x, d.z), 1.0),
    "product": lambda d: d.above(d.apply(Function.MULTIPLY, d.x, d.y), 1.0),
    "quotient": lambda d: d.above(d.apply(Function.DIVIDE, d.y, d.x), 1.0),
    "by a square": lambda d: d.above(
        d.apply(Function.DIVIDE, d.y, d.apply(Function.MULTIPLY, d.x, d.x)), -0.5
    ),
    "absolute": lambda d: d.above(d.apply(Function.ABSOLUTE, d.x), 1.0),
    "negative": lambda d: d.above(d.apply(Function.NEGATE, d.x), 1.0),
    "least": lambda d: d.above(d.apply(Function.MINIMUM, d.x, d.y), 0.5),
    "length": lambda d: d.above(d.apply(Function.NORM, d.x, d.y, d.z), 2.0),
    "angle": lambda d: d.above(d.apply(Function.YAW, d.x, d.y, d.x, d.y), 0.5),
    "age": lambda d: d.proposition(ir.AgeReaches(0, SECOND // 4)),
    "rate": lambda d: d.above(d.signal(ir.Sampled(ir.Sampling.RATE, d.x)), 0.5),
    "swing": lambda d: d.proposition(ir.Oscillates(d.x, 2, SECOND, 0.5)),
    "edges": lambda d: d.proposition(ir.Recurs(d.above(d.x, 0.5), 2, SECOND)),
    "low pass": lambda d: d.above(d.signal(ir.Sampled(ir.Sampling.LOW_PASS, d.x, SECOND)), 0.5),
}


def random_trace(seed: int) -> list[Update]:
    """Steps of up to a tenth of a second, seldom longer or backwards."""
    chance = random.Random(seed)
    at_ns, trace = 0, []
    x = y = 0.0
    for _ in range(600):
        at_ns += chance.choice((0, 1, 1, 1, 1, 1, 1, 1, 1, 3, 3, 15, -2)) * SECOND // 20
        if chance.random() < 0.3:
            x = chance.choice(NUMBERS if chance.random() < 0.9 else BROKEN)
        if chance.random() < 0.3:
            y = chance.choice(NUMBERS if chance.random() < 0.9 else BROKEN)
        is_other = chance.random() < 0.15
        values = ChannelValues({2: x}) if is_other else ChannelValues({0: x, 1: y})
        trace.append(Update(at_ns, {int(is_other): values}))
    return trace


@pytest.mark.parametrize("name", CONDITIONS)
@pytest.mark.parametrize("seed", range(3))
def test_fast_calls_say_what_the_interpreter_says(name: str, seed: int) -> None:
    machine = drafted(CONDITIONS[name])
    trace = random_trace(seed)
    wanted = observe(Interpreter(machine), trace)
    assert sum(len(step.events) for step in wanted) > 10, "the trace tells something"
    assert observe(FastCalls(machine, PythonMonitor(machine, source(machine))), trace) == wanted
