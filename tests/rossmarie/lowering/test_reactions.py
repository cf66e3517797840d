"""Lowering of the actions of rules to plans of tasks."""

from __future__ import annotations

import dataclasses
import math

import pytest

from rossmarie.ir import Machine, reactions, verify
from rossmarie.lowering import lower
from support.programs import program_of

SPEED = "input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec\n"
STOP = "action stop { block /cmd_vel : geometry_msgs/Twist ramp 1 m/s^2, 1 rad/s^2; }\n"


def machine_of(text: str) -> Machine:
    machine = lower(program_of(SPEED + text))
    verify(machine)
    return machine


def effects_of(body: str) -> tuple[reactions.Effect, ...]:
    """The effects of an action with this body, which one rule uses."""
    machine = machine_of(f"action react {{ {body} }}\nrule r: if speed > 1 m/s then {{ react; }};")
    return tuple(task.effect for task in machine.reactions.tasks)


def test_actions_without_bodies_do_nothing() -> None:
    machine = machine_of("action a;\nif speed > 1 m/s then { a; };")
    assert machine.reactions == reactions.NO_REACTIONS


def test_bounds_are_in_the_units_of_the_message() -> None:
    (limit,) = effects_of(
        "limit /cmd_vel : geometry_msgs/Twist { angular.z in [-180, 90] deg/s; linear.x in "
        "[0, 20] cm/s; } ramp 10 cm/s^2, 1 rad/s^2;"
    )
    assert isinstance(limit, reactions.Limit)
    angular, linear = map(dataclasses.astuple, limit.bounds)
    assert angular == pytest.approx((5, -math.pi, math.pi / 2, 1.0))
    assert linear == pytest.approx((0, 0.0, 0.2, 0.1))


def test_bounds_of_a_value_are_in_the_unit_that_a_system_model_gives_it() -> None:
    machine = machine_of(
        "system s { topic /c : std_msgs/Float64 in deg/s; }\n"
        "action slow { limit /c { data in [-1, 1] rad/s; } ramp 1 rad/s^2; }\n"
        "if speed > 1 m/s then { slow; };"
    )
    (task,) = machine.reactions.tasks
    assert isinstance(task.effect, reactions.Limit)
    (bound,) = map(dataclasses.astuple, task.effect.bounds)
    degrees = 180 / math.pi
    assert bound == pytest.approx((0, -degrees, degrees, degrees))
    assert machine.reactions.commands[0].fields == (
        reactions.CommandField(("data",), False, "deg/s"),
    )


def test_a_block_bounds_every_field_and_a_scale_has_a_factor() -> None:
    machine = machine_of(
        f"{STOP}action half {{ scale /cmd_vel by 50 % ramp 20 %/s; }}\n"
        "if speed > 1 m/s then { stop; half; };"
    )
    (command,) = machine.reactions.commands
    assert [field.path for field in command.fields][3] == ("angular", "x")
    assert {field.unit for field in command.fields} == {"m/s", "rad/s"}
    block, scale = (task.effect for task in machine.reactions.tasks)
    assert block == reactions.Limit(0, tuple(reactions.Bound(i, 0.0, 0.0, 1.0) for i in range(6)))
    assert scale == reactions.Scale(0, 0.5, 0.2)


def test_only_what_rules_use_passes_through_the_filter() -> None:
    machine = machine_of(
        f'{STOP}action log_it {{ log info "a"; }}\nif speed > 1 m/s then {{ log_it; }};'
    )
    assert machine.reactions.commands == ()
    assert [action.name for action in machine.reactions.actions] == ["log_it"]


def test_a_message_does_not_pass_through_the_filter_for_an_action_that_no_rule_uses() -> None:
    machine = machine_of(
        f"{STOP}action go {{ publish /cmd_vel {{ linear.x = 1 m/s; }}; }}\n"
        "if speed > 1 m/s then { go; };"
    )
    (task,) = machine.reactions.tasks
    assert isinstance(task.effect, reactions.Publish)
    assert (task.effect.command, machine.reactions.commands) == (None, ())


@pytest.mark.parametrize(("node", "command"), [("node n { publishes /lamp; }", 0), ("", None)])
def test_a_message_on_the_topic_of_a_node_takes_its_place(node: str, command: int | None) -> None:
    machine = machine_of(
        f"system s {{ topic /lamp : std_msgs/Bool; {node} }}\n"
        "action warn { publish /lamp { data = true; } at 4 Hz; }\nif speed > 1 m/s then { warn; };"
    )
    (task,) = machine.reactions.tasks
    values = (reactions.Assignment(("data",), True),)
    sent = reactions.Publish("/lamp", "std_msgs/Bool", values, 250_000_000, command)
    assert task.effect == sent
    assert machine.reactions.resources == ("topic /lamp",)


def test_values_are_in_the_units_of_the_message() -> None:
    (publish,) = effects_of(
        'publish /j : sensor_msgs/JointState { header.frame_id = "a"; position = [1, 2.5]; '
        'name = ["b", "c"]; };'
    )
    assert isinstance(publish, reactions.Publish)
    assert publish.period_ns is None
    assert [(each.path, each.value) for each in publish.assignments] == [
        (("header", "frame_id"), "a"),
        (("position",), (1.0, 2.5)),
        (("name",), ("b", "c")),
    ]


def test_what_is_awaited() -> None:
    call, set_, switch, send, cancel = effects_of(
        "call /a : std_srvs/SetBool { data = true; }; set /n.p.q in cm/s to 0.5 m/s within 1 sec;"
        "switch /m { stop a; start b, c; }; send actionlib/TwoInts { a = 1; } to /s within 3 sec "
        "then resend; cancel arm;"
    )
    values = (reactions.Assignment(("data",), True),)
    assert call == reactions.Call("/a", "std_srvs/SetBool", values, 2_000_000_000)
    assert set_ == reactions.SetParameter("/n", "p.q", 50.0, 1_000_000_000)
    assert switch == reactions.SwitchControllers("/m", ("b", "c"), ("a",), 2_000_000_000)
    goal = (reactions.Assignment(("a",), 1.0),)
    resend, drop = reactions.Interrupted.RESEND, reactions.Interrupted.DROP
    assert send == reactions.SendGoal("/s", "actionlib/TwoInts", goal, 3_000_000_000, resend)
    assert cancel == reactions.CancelGoal("/arm", None, None, 2_000_000_000, drop)


def test_words_and_the_rest() -> None:
    assert effects_of('log warning "a"; diagnose error "b"; hook c; reset;') == (
        reactions.Log(reactions.Level.WARNING, "a"),
        reactions.Diagnose(reactions.Level.ERROR, "b"),
        reactions.Hook("c"),
        reactions.Reset(),
    )


def test_a_confirmation_is_watched_once() -> None:
    machine = machine_of(
        f"{STOP}action halt {{ cancel /a confirm by speed < 0.1 m/s else stop; "
        "cancel /b confirm by speed < 0.1 m/s else stop; }\nif speed > 1 m/s then { halt; };"
    )
    (watched,) = machine.watches
    assert machine.propositions[watched].text == "speed < 0.1 m/s"
    effects = [task.effect for task in machine.reactions.tasks][:2]
    assert [isinstance(one, reactions.CancelGoal) and one.confirmation for one in effects] == [0, 0]


def test_poses_are_read_once_and_remembered_once_for_each_way_to_remember_them() -> None:
    head = "input tip = topic /tip : geometry_msgs/Point timeout 1 sec;"
    one, other = "up to 9 apart 1 cm at 2 Hz", "up to 9 apart 1 cm, 1 sec at 4 Hz"
    machine = machine_of(
        f"{head}\naction back {{ retrace tip on /a : geometry_msgs/Point {one};"
        f" retrace tip on /b : geometry_msgs/PointStamped {one};"
        f" retrace tip on /a {other}; }}\nif speed > 1 m/s then {{ back; }};"
    )
    assert [machine.signals[each].text for each in machine.readings] == ["tip.x", "tip.y", "tip.z"]
    assert machine.reactions.memories == (
        reactions.Memory((0, 1, 2), 9, 0.01, 0),
        reactions.Memory((0, 1, 2), 9, 0.01, 1_000_000_000),
    )
    (watched,) = machine.watches
    assert machine.propositions[watched].text == "all of tip is known"
    effects = [task.effect for task in machine.reactions.tasks]
    found = [
        (each.memory, each.period_ns, each.numbers[0])
        for each in effects
        if isinstance(each, reactions.Retrace)
    ]
    assert found == [
        (0, 500_000_000, ("x",)),
        (0, 500_000_000, ("point", "x")),
        (1, 250_000_000, ("x",)),
    ]


def test_a_pose_is_a_position_and_an_orientation() -> None:
    head = "input tip = topic /tip : geometry_msgs/PoseStamped timeout 1 sec;"
    machine = machine_of(
        f"{head}\naction back {{ retrace tip.pose on /a : geometry_msgs/PoseStamped"
        ' { header.frame_id = "base"; } up to 9 apart 1 cm at 2 Hz; }\n'
        "if speed > 1 m/s then { back; };"
    )
    texts = [machine.signals[each].text for each in machine.readings]
    assert texts[0] == "tip.pose.position.x"
    assert texts[3:] == [f"tip.pose.orientation.{axis}" for axis in "xyzw"]
    (task,) = machine.reactions.tasks
    assert isinstance(task.effect, reactions.Retrace)
    assert task.effect.numbers[0] == ("pose", "position", "x")
    assert task.effect.assignments == (reactions.Assignment(("header", "frame_id"), "base"),)


def test_steps_are_stages_and_also_puts_side_by_side() -> None:
    machine = machine_of(
        'action a { log info "a"; hook a; }\naction b { hook b; }\naction nothing;\n'
        "if speed > 1 m/s then { a; also b; nothing; a; };"
    )
    assert machine.reactions.plans[0].stages == ((0, 1, 2), (3, 4))


def test_escalations_have_tasks_of_their_own() -> None:
    machine = machine_of(
        f'{STOP}action lock {{ call /a : std_srvs/Trigger else home; log info "x"; }}\n'
        "action home { call /b : std_srvs/Trigger; }\nif speed > 1 m/s then { lock else stop; };"
    )
    tasks = machine.reactions.tasks
    names = [machine.reactions.actions[task.action].name for task in tasks]
    assert names == ["lock", "lock", "home", "stop"]
    assert [task.otherwise for task in tasks] == [(2,), (), (3,), ()]
    assert machine.reactions.plans[0] == reactions.RecoveryPlan(((0, 1),), (0, 1, 2, 3))


def test_the_order_is_that_of_the_file_but_for_the_priorities() -> None:
    rules = "".join(f"rule {name}: if speed > 1 m/s then {{ stop; }};\n" for name in "abcd")
    machine = machine_of(f"{STOP}{rules}priority d over b;\n")
    assert machine.reactions.order == (0, 2, 3, 1)


@pytest.mark.parametrize("uses", ["{ halt; }", "{ lock; }", "{ report else halt; }"])
def test_a_latched_action_latches_the_rules_that_use_it(uses: str) -> None:
    machine = machine_of(
        "action halt { block /cmd_vel : geometry_msgs/Twist; } latched until reset;\n"
        "action lock { call /a : std_srvs/Trigger else halt; }\naction report;\n"
        f"rule r: if speed > 1 m/s then {uses};"
    )
    assert machine.rules[0].release is None
