"""A guard lets its reactor follow the monitor: the same in C and in Python."""

from __future__ import annotations

import numpy as np
import pytest

from rossmarie import ir
from rossmarie.engines import GuardEngine, PythonGuard
from rossmarie.ir import EARLIEST_NS, LATEST_NS, ChannelValues, FieldBounds, TaskState
from rossmarie.native import load_native_guard
from rossmarie.targets.c99 import generate_guard
from rossmarie.targets.python import source
from support.c_compiler import needs_c
from support.compiled import machine_of
from support.drafts import SECOND

HEAD = """
system robot {
    topic /cmd_vel : geometry_msgs/Twist;
    node planner { publishes /cmd_vel; }
}
input speed = topic /speed : std_msgs/Float64 in m/s timeout 1 sec;
input still = topic /still : std_msgs/Bool timeout 1 sec;
input door = topic /door : std_msgs/Bool timeout 1 sec;
action slow { limit /cmd_vel { linear.x in [-0.2, 0.2] m/s; } ramp 0.1 m/s^2; }
action stop { block /cmd_vel; } latched until reset;
action give_up { cancel /move confirm by still within 2 sec; }
action forgive { reset; }
"""
SPEED, DOOR, STILL = range(3)
ENGINES = [pytest.param("native", marks=needs_c), "python"]


def guard_of(kind: str, rules: str) -> tuple[ir.Machine, GuardEngine]:
    machine = machine_of(HEAD + rules)
    if kind == "native":
        return machine, load_native_guard(machine, generate_guard(machine))
    return machine, PythonGuard(machine, source(machine))


def tell(guard: GuardEngine, at_ns: int, channel: int, value: float) -> list[str]:
    guard.update(at_ns, {channel: ChannelValues({channel: value})})
    return taken(guard)


def taken(guard: GuardEngine) -> list[str]:
    return [f"{command.kind.value} {command.task}" for command in guard.take().task_commands]


RULES = """
rule fast: if speed > 1 m/s then { slow; give_up; };
rule late: if speed > 2 m/s then { stop; };
rule closed: if door then { forgive; };
"""
SLOW, GIVE_UP, STOP, FORGIVE = range(4)


def begun(kind: str, *, is_open: bool = True) -> GuardEngine:
    """Nothing moves, and every input has arrived."""
    _, guard = guard_of(kind, RULES)
    fields = {channel: ChannelValues({channel: 0.0}) for channel in (SPEED, DOOR, STILL)}
    assert not guard.has_all_inputs
    guard.update(0, fields)
    assert guard.has_all_inputs
    if is_open:
        guard.open()
    assert taken(guard) == []
    return guard


@pytest.mark.parametrize("kind", ENGINES)
def test_task_commands_follow_at_the_instant_of_a_message(kind: str) -> None:
    guard = begun(kind)
    assert tell(guard, 1, SPEED, 1.5) == ["start 0", "start 1"]
    assert guard.active == (True, False, False)
    assert guard.states == (TaskState.HOLDING, TaskState.RUNNING, TaskState.IDLE, TaskState.IDLE)
    assert guard.bounds(1, 0)[0] == FieldBounds(1.0, -0.2, 0.2)
    assert tell(guard, 2, SPEED, 0.0) == ["stop 1", "stop 0"]
    assert guard.bounds(2 + SECOND, 0)[0] == FieldBounds(1.0, -0.2 - 0.1, 0.2 + 0.1)


@pytest.mark.parametrize("kind", ENGINES)
def test_a_confirmation_is_looked_at_with_each_message(kind: str) -> None:
    guard = begun(kind)
    tell(guard, 1, SPEED, 1.5)
    guard.report(2, GIVE_UP, success=True)
    assert guard.states[GIVE_UP] is TaskState.RUNNING
    tell(guard, 3, STILL, 1.0)
    assert guard.states[GIVE_UP] is TaskState.HOLDING


@pytest.mark.parametrize("kind", ENGINES)
def test_a_report_comes_after_what_was_due_before_it(kind: str) -> None:
    guard = begun(kind)
    tell(guard, 1, SPEED, 1.5)
    guard.report(2 * SECOND, GIVE_UP, success=True)
    reported = guard.take()
    assert guard.states[GIVE_UP] is TaskState.RUNNING, (
        "the word came in time, the confirmation did not"
    )
    instants = {event.at_ns for event in reported.events if isinstance(event, ir.Verdict)}
    assert instants == {SECOND, SECOND + 1}, "inputs have expired"


@pytest.mark.parametrize("kind", ENGINES)
def test_a_task_that_resets_does_what_an_operator_does(kind: str) -> None:
    guard = begun(kind)
    assert tell(guard, 1, SPEED, 2.5) == ["start 0", "start 2", "start 1"]
    assert tell(guard, 2, SPEED, 0.0) == ["stop 1", "stop 0"]
    assert tell(guard, 3, DOOR, 1.0) == ["start 3", "stop 2"]
    assert guard.active == (False, False, True)


@pytest.mark.parametrize("kind", ENGINES)
def test_an_operator_resets(kind: str) -> None:
    guard = begun(kind)
    tell(guard, 1, SPEED, 2.5)
    tell(guard, 2, SPEED, 0.0)
    guard.reset(3, 0)
    assert taken(guard) == []
    guard.reset(3)
    assert taken(guard) == ["stop 2"]


@pytest.mark.parametrize("kind", ENGINES)
def test_time_wakes_the_monitor_and_the_reactor(kind: str) -> None:
    guard = begun(kind)
    assert guard.next_wake() == SECOND
    tell(guard, SECOND - 1, SPEED, 1.5)
    for channel in (DOOR, STILL):
        tell(guard, SECOND - 1, channel, 0.0)
    assert guard.next_wake() == 2 * SECOND - 1
    for channel in (SPEED, DOOR, STILL):
        tell(guard, 2 * SECOND, channel, 1.5 if channel == SPEED else 0.0)
    assert guard.next_wake() == 3 * SECOND - 1, "the time of `give_up` is over"
    guard.advance(3 * SECOND - 1)
    assert taken(guard) == ["failed 1"]


@pytest.mark.parametrize("kind", ENGINES)
def test_until_it_is_opened_every_field_is_bounded_to_zero(kind: str) -> None:
    guard = begun(kind, is_open=False)
    assert set(guard.bounds(1, 0)) == {FieldBounds(1.0, 0.0, 0.0)}
    guard.open()
    assert FieldBounds(1.0, 0.0, 0.0) not in guard.bounds(1, 0)


@pytest.mark.parametrize("kind", ENGINES)
def test_a_fresh_guard_has_seen_nothing(kind: str) -> None:
    guard = begun(kind)
    tell(guard, 1, SPEED, 2.5)
    another = guard.fresh()
    assert not another.has_all_inputs
    assert set(another.states) == {TaskState.IDLE}
    assert guard.states[STOP] is TaskState.HOLDING


@pytest.mark.parametrize("kind", ENGINES)
def test_what_is_out_of_range_is_refused_and_changes_nothing(kind: str) -> None:
    guard = begun(kind)
    for at_ns in (EARLIEST_NS, LATEST_NS):
        with pytest.raises(ValueError, match="out of range"):
            guard.update(at_ns, {SPEED: ChannelValues({SPEED: 2.5})})
        with pytest.raises(ValueError, match="out of range"):
            guard.advance(at_ns)
        with pytest.raises(ValueError, match="out of range"):
            guard.reset(at_ns)
        with pytest.raises(ValueError, match="out of range"):
            guard.report(at_ns, GIVE_UP, success=False)
    for task in (-1, 4):
        with pytest.raises(IndexError, match="no task"):
            guard.report(1, task, success=True)
    assert guard.update_call(SPEED)(LATEST_NS, 2.5) == -1
    assert taken(guard) == []
    assert not any(guard.active)


@pytest.mark.parametrize("kind", ENGINES)
def test_rules_that_do_nothing_need_no_reactor(kind: str) -> None:
    text = "action slow;\ninput speed = topic /speed : std_msgs/Float64 in m/s timeout 1 sec;\n"
    machine = machine_of(text + "rule fast: if speed > 1 m/s then { slow; };")
    if kind == "native":
        guard: GuardEngine = load_native_guard(machine, generate_guard(machine))
    else:
        guard = PythonGuard(machine, source(machine))
    guard.update(0, {SPEED: ChannelValues({SPEED: 2.0})})
    guard.open()
    assert guard.active == (True,)
    assert len(guard.take().events) == 1
    assert guard.next_wake() == SECOND


def verdicts(guard: GuardEngine) -> list[ir.Verdict]:
    return [event for event in guard.take().events if isinstance(event, ir.Verdict)]


ARRAYS = """
action slow { limit /cmd_vel : geometry_msgs/Twist { linear.x in [-0.1, 0.1] m/s; }; }
input scan = topic /scan : sensor_msgs/LaserScan timeout 1 sec;
rule near: if any(scan.ranges < scan.range_min) or scan.range_max < 1 m then { slow; };
rule far: if all(scan.ranges > 5 m) then { slow; };
"""


@pytest.mark.parametrize("kind", ENGINES)
def test_a_message_is_watched_in_one_call(kind: str) -> None:
    machine = machine_of(ARRAYS.replace("scan.range_min", "0.5 m"))
    if kind == "native":
        guard: GuardEngine = load_native_guard(machine, generate_guard(machine))
    else:
        guard = PythonGuard(machine, source(machine))
    watch = guard.watch_call(0)
    wide, narrow = np.array([2.0, 3.0]), np.array([2.0, 0.25], np.float32)
    assert watch(1, 9.0, wide) == 1 + SECOND, "no rule has changed"
    assert watch(2, 9.0, narrow) is None
    assert guard.active == (True, False)
    assert [event.at_ns for event in verdicts(guard)] == [2]
    assert watch(3, 9.0, np.zeros(0)) is None
    assert guard.active == (True, True), "of no elements nothing is known"
    assert [event.at_ns for event in verdicts(guard)] == [3]
    with pytest.raises(ValueError, match="out of range"):
        watch(LATEST_NS, 9.0, wide)
    for wrong in ((9.0,), (9.0, wide, wide), ("x", wide)):
        with pytest.raises((TypeError, ValueError)):
            watch(4, *wrong)
    assert not guard.take().events


@needs_c
def test_only_arrays_of_floats_are_watched() -> None:
    machine = machine_of(ARRAYS.replace("scan.range_min", "0.5 m"))
    watch = load_native_guard(machine, generate_guard(machine)).watch_call(0)
    for wrong in (np.zeros((2, 2)), np.zeros(2, np.int64), np.zeros(4)[::2], [1.0], None):
        with pytest.raises((TypeError, ValueError, BufferError)):
            watch(1, 9.0, wrong)
    assert watch(1, 9.0, np.array([2.0])) == 1 + SECOND


@pytest.mark.parametrize("kind", ENGINES)
def test_margins_follow_messages_that_change_no_rule(kind: str) -> None:
    text = """
    input x = topic /x : std_msgs/Float64 .data in m;
    input y = topic /y : std_msgs/Float64 .data in m;
    rule near: if x < 1 m or y - 1 m < 1 m then { } feedback margin in m;
    """
    machine = machine_of(text)
    if kind == "native":
        guard: GuardEngine = load_native_guard(machine, generate_guard(machine))
    else:
        guard = PythonGuard(machine, source(machine))
    watches = [guard.watch_call(channel) for channel in range(2)]
    assert np.isnan(guard.margins[0])
    for at_ns, (channel, value, wanted) in enumerate(
        [(0, 5.0, np.nan), (1, 9.0, 4.0), (0, 3.0, 2.0), (1, 3.5, 1.5), (0, 2.25, 1.25)]
    ):
        watches[channel](at_ns, value)
        np.testing.assert_array_equal(guard.margins, [wanted])
    assert guard.active == (False,)
