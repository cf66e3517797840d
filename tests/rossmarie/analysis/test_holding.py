"""Rules that keep themselves active: behind the filter nothing clears them, and without it they are
cleared.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from rossmarie.analysis.queries import ask_all
from rossmarie.driver import compile_file
from rossmarie.interpreter import Interpreter, Reactor, TaskState
from rossmarie.ir import ChannelValues, Machine
from rossmarie.ir.reactions import Publish

INPUTS = """
system base {
    topic /cmd_vel : geometry_msgs/Twist;
    node planner { publishes /cmd_vel; }
}
input asked = topic /cmd_vel : geometry_msgs/Twist .linear timeout 0.5 sec
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec
action slow { limit /cmd_vel { linear.x in [-0.2, 0.2] m/s; }; }
action narrow { limit /cmd_vel { linear.y in [-0.2, 0.2] m/s; linear.z in [0, 0] m/s; }; }
action back { publish /cmd_vel { linear.x = -0.1 m/s; } at 10 Hz; }
action halve { scale /cmd_vel by 50 %; }
action still { scale /cmd_vel by 0 %; }
action halt { block /cmd_vel; } latched until reset;
"""

HELD = {
    "limit": ("slow;", "speed > 1 m/s", "clear when asked.x > 0.5 m/s", "ROSS717"),
    "both ends": ("slow;", "speed > 1 m/s", "clear when asked.x not in [-1, 1] m/s", "ROSS717"),
    "length": ("slow; narrow;", "speed > 1 m/s", "clear when norm(asked) > 0.5 m/s", "ROSS717"),
    "published": ("back;", "speed > 1 m/s", "clear when asked.x > 0.05 m/s", "ROSS717"),
    "scaled to zero": ("still;", "speed > 1 m/s", "clear when asked.x > 0.5 m/s", "ROSS717"),
    "in part": ("slow;", "asked.x > 0.1 m/s", "clear when asked.x not in [-1, 0.1] m/s", "ROSS717"),
    "condition": ("slow;", "asked.x < 0.3 m/s", "", "ROSS710"),
    "latched": ("halt;", "asked.x < 0.3 m/s", "", "ROSS710"),
}
ENDED = {
    "limit": ("slow;", "asked.x > 0.5 m/s", ""),
    "for some time": ("slow;", "asked.x > 0.5 m/s for 1 sec", ""),
    "in part": ("slow;", "speed > 1 m/s and asked.x > 0.5 m/s", ""),
    "published": ("back;", "asked.x > 0.05 m/s", ""),
    "scaled to zero": ("still;", "asked.x != 0 m/s", ""),
}
FREE = {
    "inside": ("slow;", "asked.x > 0.1 m/s", ""),
    "or another": ("slow;", "speed > 1 m/s or asked.x > 0.5 m/s", ""),
    "another axis": ("slow;", "asked.y > 0.5 m/s", ""),
    "latched by hand": ("slow;", "asked.x > 0.5 m/s", "latched until reset"),
    "room": ("slow;", "speed > 1 m/s", "clear when asked.x > 0.1 m/s"),
    "other field": ("slow;", "speed > 1 m/s", "clear when norm(asked) > 0.5 m/s"),
    "halved": ("halve;", "speed > 1 m/s", "clear when asked.x > 0.5 m/s"),
}


def ask(folder: Path, does: str, condition: str, contract: str) -> tuple[Machine, list[str]]:
    path = folder / "rules.ross"
    rule = f"rule one: if {condition} then {{ {does} }} {contract};"
    path.write_text(INPUTS + rule, encoding="utf-8")
    machine = compile_file(path).machine
    found = ask_all(machine, thorough=False, within_ns=10**9)
    return machine, [each.diagnostic.code for each in found]


def passed(machine: Machine, reactor: Reactor, at_ns: int, asked: float) -> dict[str, float]:
    """The output of the filter for a command with one speed in all directions."""
    asks = dict.fromkeys(("x", "y", "z"), asked)
    for task, state in zip(machine.reactions.tasks, reactor.states, strict=True):
        if isinstance(task.effect, Publish) and state is TaskState.HOLDING:
            given = {str(each.path[-1]): each.value for each in task.effect.assignments}
            asks = {axis: float(str(given.get(axis, 0.0))) for axis in asks}
    fields = [field.path for field in machine.reactions.commands[0].fields]
    bounds = dict(zip(fields, reactor.bounds(at_ns, 0), strict=True))
    return {axis: bounds["linear", axis].of(value) for axis, value in asks.items()}


def releases(
    machine: Machine,
    *,
    is_filtered: bool,
    asked_at: Callable[[int], float] = lambda tick: ((tick * 7) % 40 - 20) / 10,
    speed_at: Callable[[int], float] = lambda tick: 2.0 if tick == 0 else 0.0,
) -> int:
    """The number of times the rule is cleared or reset while a planner sends various speeds, and
    the robot has various speeds and was once fast.
    """
    monitor, reactor = Interpreter(machine), Reactor(machine.reactions)
    reactor.open()
    topics = [channel.topic for channel in machine.channels]
    cleared = 0
    for tick in range(80):
        at_ns, asked = tick * 10**8, asked_at(tick)
        free = dict.fromkeys(("x", "y", "z"), asked)
        sent = passed(machine, reactor, at_ns, asked) if is_filtered else free
        odometry = {"x": speed_at(tick)}
        values = {"/cmd_vel": sent, "/odom": odometry}
        slots: dict[int, dict[int, float]] = {index: {} for index in range(len(topics))}
        for index, slot in enumerate(machine.slots):
            channel = machine.inputs[slot.input].channel
            slots[channel][index] = values[topics[channel]][str(slot.path[-1])]
        was_active = monitor.active[0]
        monitor.update(at_ns, {channel: ChannelValues(each) for channel, each in slots.items()})
        monitor.reset(at_ns)
        cleared += was_active and not monitor.active[0]
        reactor.react(at_ns, monitor.active, ())
    return cleared


@pytest.mark.parametrize("way", HELD)
def test_what_is_said_to_hold_a_rule_does(way: str, tmp_path: Path) -> None:
    does, condition, contract, code = HELD[way]
    machine, found = ask(tmp_path, does, condition, contract)
    assert code in found
    assert releases(machine, is_filtered=True) == 0
    assert releases(machine, is_filtered=False) > 0


@pytest.mark.parametrize("way", FREE)
def test_a_rule_that_what_it_does_leaves_a_way_out_is_not_warned_of(
    way: str, tmp_path: Path
) -> None:
    machine, found = ask(tmp_path, *FREE[way])
    assert not {"ROSS710", "ROSS717", "ROSS720"} & set(found)
    assert releases(machine, is_filtered=True) > 0


@pytest.mark.parametrize("way", ENDED)
def test_a_rule_that_is_said_to_switch_itself_off_does(way: str, tmp_path: Path) -> None:
    machine, found = ask(tmp_path, *ENDED[way])

    def ended(*, is_filtered: bool) -> int:
        return releases(
            machine, is_filtered=is_filtered, asked_at=lambda _: 2.0, speed_at=lambda _: 2.0
        )

    assert "ROSS720" in found
    assert ended(is_filtered=True) > 1
    assert ended(is_filtered=False) == 0
