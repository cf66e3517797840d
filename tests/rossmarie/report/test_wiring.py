"""The wiring of rules, and its three renderings."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given

from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.report.wiring import NodeWiring, wiring_dot, wiring_of, wiring_svg, wiring_text
from rossmarie.report.wiring.model import EffectUse, Subscription, TargetKind
from support.compiled import machine_of
from support.golden import assert_golden
from support.plans import Plans, cancel, command, limit
from support.reacting import reacting_machines

GOLDEN = Path(__file__).parent / "golden"
RULES = """
system robot {
    topic /robot/cmd_vel : geometry_msgs/Twist;
    server /retract : actionlib/TwoInts;
}
input joints = topic /joints : geometry_msgs/Twist timeout 0.1 sec;
input mode = topic /mode : std_msgs/String;
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec;
input turning = topic /odom : nav_msgs/Odometry .twist.twist.angular.z timeout 0.2 sec;
action stop { block /robot/cmd_vel; }
action back { publish /robot/cmd_vel { linear.x = -0.1 m/s; } at 10 Hz; }
action careful {
    limit /robot/cmd_vel { linear.x in [0, 0.2] m/s; } ramp 0.3 m/s^2;
    call /arm/lock : std_srvs/SetBool { data = true; } within 1 sec else stop;
    set /planner.max_vel_x in m/s to 20 cm/s;
    switch /controller_manager { stop effort; start position; } else stop;
}
action halt {
    cancel /move_arm confirm by norm(joints.angular) < 0.01 rad/s within 0.5 sec else stop;
}
action retract { send { a = 1; } to /retract within 10 sec else stop; }
action warn { publish /lamp : std_msgs/Bool { data = true; } at 2 Hz; log error "no"; }
rule fast: if speed > 1.2 m/s then { careful; warn; };
rule turning_fast: if turning > 2 rad/s then { halt; retract; also warn; };
rule stuck: if mode == "stuck" then { back; };
"""


def robot() -> ir.Machine:
    """Rules that use everything that there is to use."""
    return replace(machine_of(RULES), name="robot")


def wiring() -> NodeWiring:
    return wiring_of(robot())


# --- what it says ----------------------------------------------------------------------------


def test_commands_pass_from_the_unfiltered_topic_to_the_robot() -> None:
    (found,) = wiring().commands
    assert (found.unfiltered, found.topic) == ("/robot/unfil_cmd_vel", "/robot/cmd_vel")
    assert found.message_type == "geometry_msgs/Twist"
    assert found.uses == (
        EffectUse("limit /robot/cmd_vel", "careful", ("fast",)),
        EffectUse("block /robot/cmd_vel", "stop", ("fast", "turning_fast")),
        EffectUse("publish /robot/cmd_vel at 10 Hz", "back", ("stuck",)),
    )


def test_a_topic_is_read_by_rules_and_confirmations_with_its_least_timeout() -> None:
    assert set(wiring().inputs) == {
        Subscription("/odom", "nav_msgs/Odometry", 200_000_000, ("fast", "turning_fast")),
        Subscription("/joints", "geometry_msgs/Twist", 100_000_000, ("turning_fast",)),
        Subscription("/mode", "std_msgs/String", None, ("stuck",)),
    }


def test_everything_that_rules_act_on_is_named_with_its_type() -> None:
    assert [(each.kind, each.name, each.type) for each in wiring().outputs] == [
        (TargetKind.TOPIC, "/lamp", "std_msgs/Bool"),
        (TargetKind.SERVICE, "/arm/lock", "std_srvs/SetBool"),
        (TargetKind.ACTION_SERVER, "/move_arm", None),
        (TargetKind.ACTION_SERVER, "/retract", "actionlib/TwoInts"),
        (TargetKind.PARAMETER, "/planner.max_vel_x", None),
        (TargetKind.CONTROLLER_MANAGER, "/controller_manager", None),
    ]
    assert wiring().outputs[0].uses == (
        EffectUse("publish /lamp at 2 Hz", "warn", ("fast", "turning_fast")),
    )
    assert wiring().remark is None


def test_a_server_has_the_type_that_any_task_says() -> None:
    plans = Plans()
    sent = reactions.SendGoal("/move", "a/B", (), 1, reactions.Interrupted.DROP)
    plans.rule([plans.task(sent), plans.task(cancel())])
    assert [each.type for each in wiring_of(plans.machine()).outputs] == ["a/B"]


# --- what is missing -------------------------------------------------------------------------

BARE = """
action stop;
input on = topic /on : std_msgs/Bool timeout 1 sec;
rule it: if on then { stop; };
"""


@pytest.mark.parametrize(
    ("rules", "remark"),
    [
        ("action stop;", "There are no rules"),
        (BARE, "No action of these rules has a body"),
        (BARE.replace("stop;\n", 'stop { log error "on"; }\n', 1), "No rule limits"),
    ],
    ids=["no rules", "no bodies", "no commands"],
)
def test_a_reader_is_reported_what_is_missing(rules: str, remark: str) -> None:
    found = wiring_of(machine_of(rules))
    assert (found.commands, found.outputs) == ((), ())
    assert [each.topic for each in found.inputs] == (["/on"] if "rule it" in rules else [])
    for drawn in (wiring_text(found), wiring_svg(found), wiring_dot(found)):
        assert remark in drawn


# --- how it looks ----------------------------------------------------------------------------


def test_text_looks_as_when_somebody_last_looked(*, bless: bool) -> None:
    assert_golden(GOLDEN / "wiring.txt", wiring_text(wiring(), 80), bless=bless)


def test_the_picture_looks_as_when_somebody_last_looked(*, bless: bool) -> None:
    assert_golden(GOLDEN / "wiring.svg", wiring_svg(wiring()), bless=bless)


def test_the_graph_looks_as_when_somebody_last_looked(*, bless: bool) -> None:
    assert_golden(GOLDEN / "wiring.dot", wiring_dot(wiring()), bless=bless)


@given(reacting_machines())
def test_every_rendering_names_everything(machine: ir.Machine) -> None:
    found = wiring_of(machine)
    wanted = {each.topic for each in found.inputs} | {each.name for each in found.outputs}
    wanted |= {topic for each in found.commands for topic in (each.unfiltered, each.topic)}
    text, dot = wiring_text(found), wiring_dot(found)
    drawn = [element.text for element in ET.fromstring(wiring_svg(found)).iter()]
    for name in wanted:
        assert re.search(rf"(?<!\S){re.escape(name)}(?!\S)", text)
        assert name in drawn
        assert re.search(rf'"topic {name}"|"\w[\w ]*{name}"', dot)


@given(reacting_machines())
def test_no_effect_is_left_out(machine: ir.Machine) -> None:
    found = wiring_of(machine)
    uses = [use for command in found.commands for use in command.uses]
    uses += [use for output in found.outputs for use in output.uses]
    pairs = zip(machine.rules, machine.reactions.plans, strict=True)
    rule_of = {task: rule.name for rule, plan in pairs for task in plan.tasks}
    inside = reactions.Log | reactions.Diagnose | reactions.Hook | reactions.Reset
    outside = {
        rule_of[index]
        for index, task in enumerate(machine.reactions.tasks)
        if not isinstance(task.effect, inside)
    }
    assert {rule for use in uses for rule in use.rules} == outside


@given(reacting_machines())
def test_text_fits_a_terminal(machine: ir.Machine) -> None:
    assert max(map(len, wiring_text(wiring_of(machine), 40).splitlines())) <= 40


def test_a_long_path_is_broken_before_an_arrow() -> None:
    plans = Plans()
    plans.rule([plans.task(limit(0.0, 0.0))])
    machine = plans.machine()
    long = replace(command(1), topic="/a" * 20)
    machine = replace(machine, reactions=replace(machine.reactions, commands=(long,)))
    lines = wiring_text(wiring_of(machine), 62).splitlines()
    assert lines[3:6] == [
        "  planner --> " + "/a" * 19 + "/unfil_a",
        "  --> reacting_safety",
        "  --> " + "/a" * 20 + " --> robot",
    ]
