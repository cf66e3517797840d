"""An action server behind the guard: whose goal it has, and what becomes of the others."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from heron.goals import Goal
from heron.guard import InProcessGuard
from heron.topics import NodeParameter
from support.guarding import Guarded

SECOND = 1_000_000_000
PLACE = {"a": 1}
RETRACT = {"a": 2, "b": 0}
RULES = """
system robot {
    server /arm : actionlib/TwoInts;
    topic /odom : nav_msgs/Odometry;
}
input speed = topic /odom .twist.twist.linear.x timeout 100 sec;
action halt { cancel /arm within 0.5 sec then resend else give_up; }
action drop { cancel /arm within 0.5 sec then drop else give_up; }
action retract { send { a = 2; b = 0; } to /arm within 2 sec then resend else give_up; }
action soften { set /arm_controller.stiffness in N/m to 200 N/m within 1 sec else give_up; }
action give_up { publish /drive/boost : std_msgs/Bool { data = true; }; }
"""


class Arm:
    """A server that ends its goals when it is told to."""

    def __init__(self) -> None:
        self.heard: list[Goal | None] = []
        self.done: Callable[[bool], None] = lambda _: None

    def send(self, goal: Goal, done: Callable[[bool], None]) -> None:
        self.heard.append(goal)
        self.done = done

    def cancel(self) -> None:
        self.heard.append(None)
        self.done(False)


class Scene:
    """A guard in front of an arm, and a client."""

    def __init__(self, tmp_path: Path, rule: str) -> None:
        path = tmp_path / "rules.ross"
        path.write_text(RULES + f"rule r: if speed > 1 m/s then {{ {rule} }};", encoding="utf-8")
        self.guarded = Guarded()
        self.arm = Arm()
        self.stiffness = 500.0
        self.results: list[bool] = []
        self.guarded.carrier.serve("/arm", self.arm)
        parameter = NodeParameter(lambda: self.stiffness, self._set)
        self.guarded.carrier.declare("/arm_controller.stiffness", parameter)
        self.guard: InProcessGuard = self.guarded.start(path)
        self.guarded.speed(0.0)

    def send(self, goal: Goal) -> None:
        self.guarded.carrier.server("/unfil_arm").send(goal, self.results.append)

    def _set(self, value: float) -> None:
        self.stiffness = value


def test_goals_of_clients_pass(tmp_path: Path) -> None:
    scene = Scene(tmp_path, "halt;")
    scene.send(PLACE)
    scene.arm.done(True)
    assert scene.arm.heard == [PLACE]
    assert scene.results == [True]


def test_a_goal_that_is_cancelled_goes_on_afterwards(tmp_path: Path) -> None:
    scene = Scene(tmp_path, "halt;")
    scene.send(PLACE)
    scene.guarded.speed(2.0)
    assert scene.arm.heard == [PLACE, None]
    assert scene.results == [], "the client does not learn of it"
    scene.guarded.speed(0.0)
    assert scene.arm.heard == [PLACE, None, PLACE]
    scene.arm.done(True)
    assert scene.results == [True]


def test_a_goal_may_be_dropped(tmp_path: Path) -> None:
    scene = Scene(tmp_path, "drop;")
    scene.send(PLACE)
    scene.guarded.speed(2.0)
    scene.guarded.speed(0.0)
    assert scene.arm.heard == [PLACE, None]
    assert scene.results == [False]


def test_goals_that_come_meanwhile_wait_and_the_last_one_counts(tmp_path: Path) -> None:
    scene = Scene(tmp_path, "halt;")
    scene.guarded.speed(2.0)
    scene.send({"a": 7})
    scene.send(PLACE)
    assert scene.arm.heard == []
    assert scene.results == [False]
    scene.guarded.speed(0.0)
    assert scene.arm.heard == [PLACE]


def test_a_rule_sends_its_own_goal_in_between(tmp_path: Path) -> None:
    scene = Scene(tmp_path, "halt; retract;")
    scene.send(PLACE)
    scene.guarded.speed(2.0)
    assert scene.arm.heard == [PLACE, None, RETRACT]
    scene.arm.done(True)
    scene.guarded.speed(0.0)
    assert scene.arm.heard == [PLACE, None, RETRACT, PLACE]
    assert scene.results == []


def test_a_goal_of_a_rule_is_cancelled_with_it(tmp_path: Path) -> None:
    scene = Scene(tmp_path, "retract;")
    scene.guarded.speed(2.0)
    scene.guarded.speed(0.0)
    assert scene.arm.heard == [RETRACT, None]


def test_a_goal_that_is_not_reached_escalates(tmp_path: Path) -> None:
    scene = Scene(tmp_path, "retract;")
    scene.guarded.speed(2.0)
    scene.arm.done(False)
    assert len(scene.guarded.boosts) == 1


def test_a_goal_that_takes_too_long_escalates(tmp_path: Path) -> None:
    scene = Scene(tmp_path, "retract;")
    scene.guarded.speed(2.0)
    scene.guarded.pass_time(scene.guard, 3 * SECOND, lambda: None)
    assert scene.guarded.boosts == [2 * SECOND]


def test_a_parameter_gets_its_old_value_back(tmp_path: Path) -> None:
    scene = Scene(tmp_path, "soften;")
    scene.guarded.speed(2.0)
    assert scene.stiffness == 200.0
    assert scene.guard.is_acting
    scene.guarded.speed(0.0)
    assert scene.stiffness == 500.0
    assert not scene.guard.is_acting
