"""S65 and S66: the way on which a robot slows down, and that it is slow when it arrives."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, TruthValue
from support.compiled import machine_of
from support.rule_skills import FILE

F, T, _, L = TruthValue
NAN = math.nan
BRAKE, ACCELERATION, FASTEST, LATENCY, TIMEOUT = 0.6, 0.5, 1.5, 0.2, 0.4
REACTION = LATENCY + TIMEOUT
BEGIN, END = 20.0, 24.0
"""The ends of the school's corridor along x."""
NS = 1_000_000_000


def rules(condition: str, speed_topic: str = "/odom") -> str:
    return f"""
skills "{FILE}";
action slow;
input pose = topic /odom : nav_msgs/Odometry .pose.pose timeout {TIMEOUT} sec;
input speed = topic {speed_topic} : nav_msgs/Odometry .twist.twist.linear.x timeout {TIMEOUT} sec;
motion drive {{
    position : pose;
    speed : speed;
    brake : {BRAKE} m/s^2;
    acceleration : {ACCELERATION} m/s^2;
    fastest : {FASTEST} m/s;
    latency : {LATENCY} sec;
}}
rule r: if {condition} then {{ slow; }};
"""


class Watched:
    """A rule, and what it says of a robot."""

    def __init__(self, condition: str, speed_topic: str = "/odom") -> None:
        self.machine = machine_of(rules(condition, speed_topic))
        self._monitor = Interpreter(self.machine)

    def see(self, at_ns: int, x: float, speed: float) -> None:
        known = {"x": speed, "y": 1.0, "frame_id": 0.0}
        messages: dict[int, ChannelValues] = {}
        for channel in range(len(self.machine.channels)):
            slots = {
                number: x if "pose" in slot.path and slot.path[-1] == "x" else known[slot.path[-1]]
                for number, slot in enumerate(self.machine.slots)
                if self.machine.inputs[slot.input].channel == channel
                and isinstance(slot.path[-1], str)
            }
            messages[channel] = ChannelValues(slots)
        self._monitor.update(at_ns, messages)

    @property
    def proposition(self) -> TruthValue:
        found = self._monitor._memory.truth_values[self.machine.rules[0].condition]
        assert found is not None
        return found

    def says(self, speed: float) -> TruthValue:
        self.see(1, 0.0, speed)
        return self.proposition


def distance(speed: float, wanted: float, travelling: float | None = None) -> float:
    reached = min(abs(speed) + ACCELERATION * REACTION, FASTEST)
    covered = (reached if travelling is None else travelling) * REACTION
    return covered + (reached**2 - wanted**2) / (2.0 * BRAKE)


@pytest.mark.parametrize("speed", [0.0, 0.4, -0.4, 1.2, 7.0])
@pytest.mark.parametrize("wanted", [0.0, 0.3])
def test_s65_the_way_to_stop(speed: float, wanted: float) -> None:
    """It is the same for a robot that drives backwards."""
    argument = f", {wanted} m/s" if wanted else ""
    metres = distance(speed, wanted)
    for limit, expected in ((metres + 1e-9, F), (metres - 1e-9, T)):
        assert Watched(f"stopping(drive{argument}) > {limit!r} m").says(speed) is expected


def test_s65_slow_enough_needs_no_way() -> None:
    slow = Watched("stopping(drive, 0.5 m/s) == 0 m")
    assert slow.says(0.5 - ACCELERATION * REACTION - 1e-9) is T
    assert slow.says(0.5 - ACCELERATION * REACTION + 1e-9) is F


def test_s65_messages_apart() -> None:
    """The robot may have been faster when its position was measured."""
    metres = distance(0.2, 0.3, travelling=FASTEST)
    for limit, expected in ((metres + 1e-9, F), (metres - 1e-9, T)):
        apart = Watched(f"stopping(drive, 0.3 m/s) > {limit!r} m", speed_topic="/wheels")
        assert apart.says(0.2) is expected


def test_s65_a_speed_that_is_stale() -> None:
    assert Watched("stopping(drive) > 1 m").says(NAN) is L


# --- in time -----------------------------------------------------------------------------------


@dataclass
class Robot:
    """Does its worst: within what its motion declares, it is as fast as it can be."""

    x: float
    speed: float
    brakes_from_ns: int | None = None
    at_ns: int = 0
    entered: list[float] = field(default_factory=list)
    """The speeds at which it was in the corridor at the ends of steps."""

    def go_on(self, to_ns: int, wanted: float, push: float) -> None:
        """Drive on, in steps of a constant acceleration."""
        while self.at_ns < to_ns:
            step_ns = min(5_000_000, to_ns - self.at_ns)
            brakes = self.brakes_from_ns is not None and self.at_ns >= self.brakes_from_ns
            if brakes:
                target = max(wanted, self.speed - BRAKE * step_ns / NS)
                after = min(self.speed, target) if self.speed > wanted else self.speed
            else:
                after = min(FASTEST, self.speed + push * step_ns / NS)
            self.x += (self.speed + after) / 2 * step_ns / NS
            self.speed = after
            self.at_ns += step_ns
            if BEGIN < self.x < END:
                self.entered.append(self.speed)


@example(0.3, 1e-6, FASTEST, [0.399] * 60, [ACCELERATION] * 60)
@example(0.0, 1e-6, 0.9, [0.399] * 60, [ACCELERATION] * 60)
@given(
    wanted=st.sampled_from([0.0, 0.2, 0.5]),
    spare=st.one_of(st.just(1e-6), st.floats(1e-6, 3.0)),
    speed=st.floats(0.0, FASTEST),
    gaps=st.lists(st.sampled_from([0.02, 0.1, 0.299, 0.399]), min_size=60, max_size=60),
    pushes=st.lists(
        st.sampled_from([ACCELERATION, ACCELERATION, 0.0, -0.3]), min_size=60, max_size=60
    ),
)
def test_s66_the_robot_is_slow_when_it_arrives(
    wanted: float, spare: float, speed: float, gaps: list[float], pushes: list[float]
) -> None:
    """Brakes hold after the latency, for as long as the rule is active, and no stronger than they
    have to; messages come as late as they may.
    """
    watched = Watched(f"distance(pose, SchoolCorridor) < stopping(drive, {wanted} m/s)")
    robot = Robot(BEGIN - max(distance(speed, wanted), 0.0) - spare, speed)
    watched.see(0, robot.x, robot.speed)
    assert watched.proposition is F
    for gap, push in zip(gaps, pushes, strict=False):
        robot.go_on(robot.at_ns + round(gap * NS), wanted, push)
        watched.see(robot.at_ns, robot.x, robot.speed)
        if watched.proposition is F:
            robot.brakes_from_ns = None
        elif robot.brakes_from_ns is None:
            robot.brakes_from_ns = robot.at_ns + round(LATENCY * NS)
    assert all(each <= wanted + 1e-6 for each in robot.entered)
