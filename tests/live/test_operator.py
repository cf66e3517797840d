"""An operator's view of a running node, and the operator's commands."""

from __future__ import annotations

import time
from collections.abc import Callable

from support.live import Process, Robot, until

Start = Callable[..., Process]


def test_a_reset_is_refused_while_it_is_unsafe(robot: Robot, start: Start) -> None:
    start()
    robot.passes(1.0)
    robot.set(pitch=40.0)
    robot.passes(0.0)
    refused = robot.call("reset", rule="fallen")
    assert not refused["success"]
    assert "abs(orientation.pitch()) > 30 deg" in refused["message"]
    robot.set(pitch=0.0)
    robot.stays_at(0.0)
    until(lambda: robot.call("reset", rule="fallen")["success"], "it is safe")
    robot.passes(1.0)


def test_a_latched_rule_outlives_the_node(robot: Robot, start: Start) -> None:
    node = start()
    robot.passes(1.0)
    robot.set(pitch=40.0)
    robot.passes(0.0)
    until(lambda: robot.state().get("active") == ["tilted", "fallen"], "the state is reported")
    node.end()
    robot.ask(forget="/vehicle_safety/state")
    robot.set(pitch=0.0)
    start()
    until(lambda: robot.state().get("open", False), "the node has all inputs")
    robot.stays_at(0.0)
    assert "latched before the node started" in robot.call("why")["text"]
    assert robot.call("reset", rule="")["success"]
    robot.passes(1.0)


def test_verdicts_say_why_with_values_and_units(robot: Robot, start: Start) -> None:
    start()
    robot.passes(1.0)
    robot.ask(forget="/vehicle_safety/verdicts")
    robot.set(pitch=15.0)
    until(lambda: bool(robot.heard("/vehicle_safety/verdicts")), "a verdict is reported")
    verdict = robot.heard("/vehicle_safety/verdicts")[0]
    assert (verdict["rule"], verdict["change"]) == ("tilted", 1)
    assert (
        verdict["cause"] == "abs(orientation.pitch()) = 15 deg; abs(orientation.pitch()) > 10 deg"
    )
    (value,) = verdict["values"]
    assert (value["name"], value["unit"]) == ("abs(orientation.pitch())", "deg")
    assert abs(value["value"] - 15.0) < 1e-6
    assert verdict["actions"][0] == "slow: limit /cmd_vel"


def test_an_exemption_ends_by_itself(robot: Robot, start: Start) -> None:
    start()
    robot.set(pitch=15.0)
    robot.passes(0.2)
    assert not robot.call("exempt", rule="tilted", time=1.0, reason="")["success"]
    robot.ask(forget="/cmd_vel")
    begin = time.time()
    assert robot.call("exempt", rule="tilted", time=2.0, reason="a test drive")["success"]
    until(lambda: max(robot.speeds(), default=0.0) > 0.2, "commands pass")
    until(lambda: robot.last("/cmd_vel") == 0.2, "the exemption is over")
    reported = robot.ask(heard="/cmd_vel")
    passed = next(at for at, speed in reported if speed > 0.2)
    assert next(at for at, speed in reported if at > passed and speed == 0.2) - begin > 2.0
    until(lambda: robot.state().get("exempted") == [], "the state is reported")
    assert ["tilted"] in [each["exempted"] for each in robot.heard("/vehicle_safety/state")]


def test_actions_publish_call_and_fail(robot: Robot, start: Start) -> None:
    start()
    robot.passes(1.0)
    robot.set(pitch=40.0)
    robot.passes(0.0)
    until(lambda: robot.heard("/lamp") == [True], "the service is called")
    robot.ask(forget="/horn")
    until(lambda: robot.count("/horn") > 8, "it is published again and again")
    sounded = [at for at, _ in robot.ask(heard="/horn")]
    assert sounded[8] - sounded[0] > 8 / 5 / 2, "5 in a second, or twice that after a pause"
    robot.set(pitch=0.0, lamp=False)
    until(lambda: robot.call("reset", rule="")["success"], "it is safe")
    robot.set(pitch=40.0)
    until(lambda: "failed" in states(robot), "a call that is refused has failed")


def states(robot: Robot) -> list[str]:
    state = robot.state()
    return [task["state"] for task in state["tasks"]] if state else []
