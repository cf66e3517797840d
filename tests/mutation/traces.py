"""Traces for the rules in `rules.ross`: always the same, and close to their limits."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from random import Random

from rossmarie import ir
from rossmarie.interpreter import Reactor, TaskState
from rossmarie.ir import ChannelValues, TruthValue
from rossmarie.ir.script import Script
from rossmarie.testing.run import run
from support.machines import Advance, Reset, Step, Update
from support.reacting import Look, ReactingCase, look

_TICK = 2 * 10**7
_LIMITS = {"/imu": (0.2,), "/odom": (0.01, 0.5, 1.0), "/slope": (5.0,), "/spot": (2.0,)}
"""The limits of the numbers of a topic, in its unit. The limits of arrays follow below."""

_ELEMENTS = (0.4, 0.6, 0.8, 1.0, 1.2)
_ODD = (math.nan, math.nan, math.inf, -math.inf)
_PLACES = (*map(float, range(8)), 0.3, 0.4, math.nan)
_ORIENTATIONS = (
    *((0.0, math.sin(half), 0.0, math.cos(half)) for half in map(math.radians, (0, 4.9, 5.1, 40))),
    (
        -0.2600896669038415,
        0.20784007719238895,
        0.2600896669038415,
        0.20784007719238895,
    ),  # its sine is above 1 by rounding
    (0.0, 0.0, 0.0, 0.0),
    (0.0, math.nan, 0.0, 1.0),
)


Make = Callable[[ir.Machine, Random, int], ChannelValues]


class _Recorder:
    """An engine that notes what it is reported."""

    def __init__(self) -> None:
        self.steps: list[Step] = []

    def update(self, at_ns: int, messages: Mapping[int, ChannelValues]) -> list[ir.Event]:
        self.steps.append(Update(at_ns, messages))
        return []

    def advance(self, at_ns: int) -> list[ir.Event]:
        self.steps.append(Advance(at_ns))
        return []

    def reset(self, at_ns: int, rule: int | None = None) -> list[ir.Event]:
        self.steps.append(Reset(at_ns, rule))
        return []


def scripted(machine: ir.Machine, script: Script) -> Sequence[Step]:
    """The steps of an engine in a test of a rules file."""
    recorder = _Recorder()
    run(recorder, machine, script)
    return recorder.steps


def random_trace(machine: ir.Machine, steps: int, make: Make | None = None) -> list[Step]:
    """One long trace with silence, equal instants and jumps back. `make` makes a message on a
    channel, by its index; else they are those of `rules.ross`.
    """
    random = Random(1)
    at_ns = 0
    latest: dict[int, ChannelValues] = {}
    found = []
    for _ in range(steps):
        at_ns = _later(random, at_ns)
        for channel in range(len(machine.channels)):
            if channel not in latest or random.random() < 0.3:
                latest[channel] = (make or _message)(machine, random, channel)
        found.append(_step(machine, random, at_ns, latest))
    return found


def _later(random: Random, at_ns: int) -> int:
    if random.random() < 0.01:
        return at_ns - random.choice((1, _TICK, 10 * _TICK))
    ticks = random.choice((0, 0, 1, 1, 1, 1, 2, 2, 5, 10))
    if random.random() < 0.015:
        ticks = random.choice((50, 125, 150))
    return at_ns + ticks * _TICK + (random.choice((0, 0, 0, 1, -1)) if ticks else 0)


def _step(
    machine: ir.Machine, random: Random, at_ns: int, latest: Mapping[int, ChannelValues]
) -> Step:
    match random.randrange(20):
        case 0 | 1:
            return Advance(at_ns)
        case 2 | 3:
            return Reset(at_ns, random.choice((None, *range(len(machine.rules)))))
        case _:
            channels = [random.randrange(len(machine.channels))]
            if random.random() < 0.7:  # the first has the shortest timeout
                channels = sorted({0, *channels})
            return Update(at_ns, {each: latest[each] for each in channels})


def _message(machine: ir.Machine, random: Random, channel: int) -> ChannelValues:
    limits = _LIMITS.get(machine.channels[channel].topic, ())
    orientation = random.choice(_ORIENTATIONS)
    slots = {}
    for index, slot in enumerate(machine.slots):
        if machine.inputs[slot.input].channel == channel:
            if slot.kind is not ir.FieldKind.REAL:
                slots[index] = random.choice((0.0, 1.0))
            elif slot.path[0] == "orientation":
                slots[index] = orientation["xyzw".index(str(slot.path[1]))]
            else:
                slots[index] = random.choice((1.0, -1.0)) * _number(random, limits)
    arrays = {
        index: [_number(random, _ELEMENTS) for _ in range(random.randrange(5))]
        for index, array in enumerate(machine.arrays)
        if machine.inputs[array.input].channel == channel
    }
    return ChannelValues(slots, arrays)


def _number(random: Random, limits: Sequence[float]) -> float:
    """A limit, or right beside it, or some way off; now and then nothing."""
    if random.random() < 0.03:
        return random.choice(_ODD)
    limit = random.choice(limits)
    steps = (math.nextafter(limit, 0.0), math.nextafter(limit, math.inf))
    return random.choice((0.0, limit, *steps, limit / 2, limit * 1.5, limit * 3))


def chosen_traces(machine: ir.Machine) -> list[list[Step]]:
    """Traces for cases that chance meets too seldom: a limit that is reached, an unknown beside
    a proposition, a swing that is just wide enough, a number that leaps over an interval and stays
    there, and an edge that falls out of its window before any other timer.
    """
    swinging = [
        Update(n * 5 * _TICK, _messages(machine, {"/imu": (0.0, 0.0, 0.0, 1.0, y)}))
        for n, y in enumerate((0.0, 0.2, -0.1, 0.3, -0.1))
    ]
    near = Update(0, _messages(machine, {"/scan": (0.4, 0.7)}))
    crowded = Update(0, _messages(machine, {"/scan": (0.7, 0.7, 0.7), "/odom": (0.0,)}))
    leaping = [
        Update(n * 10 * _TICK, _messages(machine, {"/odom": (speed,)}))
        for n, speed in enumerate((-1.5, *[1.5] * 8))
    ]
    level = {"/imu": (0.0, 0.0, 0.0, 1.0, 0.0), "/docked": (0.0,)}
    docked = _messages(machine, {"/docked": (1.0,)})
    docking = [
        Update(0, _messages(machine, level)),
        Update(2 * _TICK, docked),
        Update(2 * _TICK + 155_000_000, docked),
    ]
    return [[near], [crowded], [*swinging], [*leaping], [*docking]]


def _messages(
    machine: ir.Machine, numbers: Mapping[str, Sequence[float]]
) -> dict[int, ChannelValues]:
    """Messages by topic: the numbers of slots in their order, or the elements of the array."""
    found = {}
    for index, channel in enumerate(machine.channels):
        if channel.topic in numbers:
            slots = [n for n, x in enumerate(machine.slots) if _channel(machine, x) == index]
            arrays = [n for n, x in enumerate(machine.arrays) if _channel(machine, x) == index]
            given = numbers[channel.topic]
            found[index] = ChannelValues(
                dict(zip(slots, given, strict=False)), {array: list(given) for array in arrays}
            )
    return found


def _channel(machine: ir.Machine, carried: ir.Slot | ir.Array) -> int | None:
    return machine.inputs[carried.input].channel


def random_events(machine: ir.Machine, events: int) -> ReactingCase:
    """One long run of the reactor; tasks that are said to have ended were mostly running, and now
    and then it is the very instant at which their time is up.
    """
    random = Random(1)
    reactor = Reactor(machine.reactions)
    engaged = [False] * len(machine.rules)
    at_ns, found = 0, []
    for _ in range(events):
        due_ns = reactor.next_wake()
        at_ns = due_ns if due_ns and random.random() < 0.1 else _later(random, at_ns)
        running = [n for n, state in enumerate(reactor.states) if state is TaskState.RUNNING]
        report = None
        if running and random.random() < 0.4:
            report = (random.choice(running), random.random() < 0.7)
        else:
            for rule in random.sample(range(len(engaged)), random.choice((1, 1, 2, 3))):
                engaged[rule] = not engaged[rule]
        watches = tuple(random.choice((TruthValue.TRUE, *TruthValue)) for _ in machine.watches)
        poses = tuple(random.choice(_PLACES) for _ in machine.readings)
        found.append(Look(at_ns, tuple(engaged), watches, report, poses))
        look(reactor, found[-1])
    return ReactingCase(machine, found, opens_before=5)
