"""Random machines with random reactions, and what happens to a guard of theirs.

@given(guard_cases())
def test_same(case: GuardCase) -> None:
assert observe_guard(one(case.machine), case) == observe_guard(other(case.machine), case)
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.engines import GuardEngine
from rossmarie.ir import reactions
from rossmarie.native.signatures import fields_of
from support.growing import TICK
from support.machines import NAN, Advance, Reset, Step, Update, exactly, machines, traces
from support.reacting import READINGS, Sprouting, reacting_machines

LATER = (0, 1, TICK // 3, 3 * TICK, -TICK)
"""The times at which bounds are queried, counted from a step."""


@st.composite
def guarded_machines(draw: st.DrawFn) -> ir.Machine:
    """A random machine whose rules do something at random; half of them rest on a flag each."""
    machine = draw(st.one_of(reacting_machines(), _grown()))
    tasks = tuple(draw(_at_times_a_reset(task)) for task in machine.reactions.tasks)
    guarded = replace(machine, reactions=replace(machine.reactions, tasks=tasks))
    ir.verify(guarded)
    return guarded


@st.composite
def _grown(draw: st.DrawFn) -> ir.Machine:
    """A machine of every kind of node, at times without any task."""
    machine = draw(machines())
    shown = {signal for rule in machine.rules for signal in rule.signals}
    read = sorted(each for each in shown if isinstance(machine.signals[each].node, ir.Read))
    sprouting = Sprouting(draw, watches=len(machine.watches), retraces=bool(read))
    for _ in machine.rules:
        sprouting.rule()
    if not sprouting.tasks:
        return machine
    readings = tuple(draw(st.sampled_from(read)) for _ in range(READINGS if read else 0))
    return replace(machine, reactions=sprouting.made(), readings=readings)


@st.composite
def _at_times_a_reset(draw: st.DrawFn, task: reactions.Task) -> reactions.Task:
    is_replaced = task.resource is None and draw(st.integers(0, 7)) == 0
    return replace(task, effect=reactions.Reset()) if is_replaced else task


@dataclass(frozen=True)
class Course:
    """A trace for a guard: steps of its monitor, with a report of a task after some steps. The
    guard opens before one of the steps, or never.
    """

    steps: list[Step]
    reports: list[tuple[int, bool] | None]
    opens_before: int


@dataclass(frozen=True)
class GuardCase:
    """A machine, and what happens to guards of it."""

    machine: ir.Machine
    courses: list[Course]


@st.composite
def guard_cases(draw: st.DrawFn) -> GuardCase:
    """Several traces for one machine, which costs a compilation."""
    machine = draw(guarded_machines())
    return GuardCase(machine, [draw(_courses(machine)) for _ in range(_COURSES)])


_COURSES = 4


@st.composite
def _courses(draw: st.DrawFn, machine: ir.Machine) -> Course:
    steps = draw(traces(machine, max_steps=30))
    tasks = len(machine.reactions.tasks)
    report = st.tuples(st.integers(0, tasks - 1), st.sampled_from((True, True, False)))
    choice = st.one_of(st.none(), report, report) if tasks else st.none()
    opens_before = draw(st.sampled_from((0, 0, 0, 3, 99)))
    return Course(steps, [draw(choice) for _ in steps], opens_before)


@dataclass(frozen=True)
class GuardObservation:
    """All that a guard shows after a step."""

    events: tuple[object, ...]
    task_commands: tuple[ir.TaskCommand, ...]
    active: tuple[bool, ...]
    states: tuple[ir.TaskState, ...]
    next_wake: int | None
    has_all_inputs: bool
    bounds: tuple[str, ...]


def observe_guard(
    guard: GuardEngine, machine: ir.Machine, course: Course
) -> list[GuardObservation]:
    """Let it happen and note everything, numbers by their bits."""
    found = []
    for number, (step, report) in enumerate(zip(course.steps, course.reports, strict=True)):
        if number == course.opens_before:
            guard.open()
        take(guard, machine, step)
        found.append(_observed(guard, machine, step.at_ns))
        if report is not None:
            task, success = report
            guard.report(step.at_ns, task, success=success)
            found.append(_observed(guard, machine, step.at_ns))
    return found


def take(guard: GuardEngine, machine: ir.Machine, step: Step) -> None:
    """Do one step; a message of scalars comes the fastest way."""
    match step:
        case Update(at_ns, messages):
            (channel, *others) = messages
            fields = fields_of(machine)[channel]
            if others or fields.lists:
                guard.update(at_ns, messages)
                return
            values = messages[channel]
            numbers = [values.slots.get(slot, NAN) for slot in fields.slots]
            arrays = [np.array(values.arrays.get(each, ()), np.float64) for each in fields.arrays]
            wake_ns = guard.watch_call(channel)(at_ns, *numbers, *arrays)
            due_ns = guard.next_wake()  # may be 0
            assert wake_ns in (None, ir.NEVER_NS if due_ns is None else due_ns)
        case Advance(at_ns):
            guard.advance(at_ns)
        case Reset(at_ns, rule):
            guard.reset(at_ns, rule)


def _observed(guard: GuardEngine, machine: ir.Machine, at_ns: int) -> GuardObservation:
    reported = guard.take()
    return GuardObservation(
        tuple(exactly(event) for event in reported.events),
        tuple(reported.task_commands),
        guard.active,
        guard.states,
        guard.next_wake(),
        guard.has_all_inputs,
        tuple(_bits(guard, machine, at_ns)),
    )


def _bits(guard: GuardEngine, machine: ir.Machine, at_ns: int) -> Sequence[str]:
    return [
        f"{bound.factor.hex()} {bound.low.hex()} {bound.high.hex()}"
        for later in LATER
        for index in range(len(machine.reactions.commands))
        for bound in guard.bounds(at_ns + later, index)
    ]
