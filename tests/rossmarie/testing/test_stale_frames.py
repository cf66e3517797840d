"""A frame that stays is stale only until it has come: tests are written of that, and cover it."""

from __future__ import annotations

from rossmarie import ir
from rossmarie.ir.script import ScriptedArrival
from rossmarie.testing.coverage import cover
from rossmarie.testing.goals import Aspect
from rossmarie.testing.propose import propose
from support.compiled import machine_of

RULES = """
system robot {
    frame camera in base;
    topic /hand : geometry_msgs/PoseStamped from camera;
}
action stop;
input hand = topic /hand .pose in base timeout 0.5 sec;
rule near: if hand.position.x < 0.5 m then { stop; };
"""


def test_a_frame_that_has_not_come_is_proposed() -> None:
    machine = machine_of(RULES)
    proposals = {each.script.name: each.script for each in propose(machine)}
    script = proposals["near: camera has not come yet"]
    topic = machine.channels[camera(machine)].topic
    sent = [e for e in script.events if isinstance(e, ScriptedArrival) and topic in e.topics]
    assert min(event.first_ns for event in sent) > 0
    assert script.end_ns < 10**10


def test_it_is_covered_where_it_has_not_come() -> None:
    machine = machine_of(RULES)
    scripts = [each.script for each in propose(machine)]
    stale = {
        machine.inputs[goal.subject].name
        for goal in cover(machine, scripts).reached
        if goal.aspect is Aspect.STALE
    }
    assert stale == {"hand", "camera"}


def camera(machine: ir.Machine) -> int:
    return next(i for i, each in enumerate(machine.channels) if each.edge is not None)
