"""The content of a generated catkin package, without ROS."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest

from rossmarie.driver.build import generate
from rossmarie.targets import ros1
from support.live_cases import acting, vehicle


def test_packages_of_all_messages_are_named() -> None:
    files = generate(vehicle(), "ros1")
    depends = {each.text for each in ET.fromstring(files["package.xml"]).iter("depend")}
    assert depends == {
        "actionlib",
        "actionlib_msgs",
        "controller_manager_msgs",
        "topic_tools",
        "diagnostic_msgs",
        "geometry_msgs",
        "roscpp",
        "sensor_msgs",
        "std_msgs",
        "std_srvs",
    }
    for package in depends:
        assert f"\n  {package}" in files["needs.cmake"]


def test_the_planner_is_launched_behind_the_filter() -> None:
    """In the namespace of the node, and by the full name."""
    launch = ET.fromstring(generate(vehicle(), "ros1")["launch/vehicle_safety_robot.launch"])
    group = launch.find("group")
    assert group is not None
    space = "$(eval ('/' + arg('namespace').strip('/')).rstrip('/') + '%s')"
    assert [dict(each.attrib) for each in group.iter("remap")] == [
        {"from": "cmd_vel", "to": "unfil_cmd_vel"},
        {"from": space % "/cmd_vel", "to": space % "/unfil_cmd_vel"},
        {"from": "arm_vel", "to": "unfil_arm_vel"},
        {"from": space % "/arm_vel", "to": space % "/unfil_arm_vel"},
    ]
    assert [each.attrib["respawn"] for each in launch.iter("node")] == ["true"]


def test_what_the_node_cannot_do_is_refused() -> None:
    (found,) = ros1.unsupported(acting("set /planner.FollowPath.speed to 0.2"))
    assert (found.code, found.title) == (
        "ROSS503",
        "the target ros1 cannot carry out `set /planner.FollowPath.speed to 0.2`",
    )
    assert list(ros1.unsupported(vehicle())) == []


EFFECTS = {
    "cancel /arm within 1 sec": ({"cancel_task.h"}, {"actionlib_msgs", "topic_tools"}),
    "send actionlib/Test { goal = 1; } to /arm within 1 sec": (
        {"ros1/send_task.h"},
        {"actionlib", "actionlib_msgs", "topic_tools"},
    ),
    "set /planner.speed to 1": (
        {"ros1/set_task.h"},
        set(),
    ),
    "switch /manager { start a; }": (
        {"switch_task.h"},
        {"controller_manager_msgs"},
    ),
    'log info "x"': (set(), set()),
}


@pytest.mark.parametrize("effect", EFFECTS)
def test_what_only_some_effects_need_is_there_for_these_only(effect: str) -> None:
    files = generate(acting(effect), "ros1")
    headers, packages = EFFECTS[effect]
    every = set().union(*(each for each, _ in EFFECTS.values()))
    text = files["src/rules.cpp"]
    assert {name for name in every if f'#include "runtime/{name}"' in text} == headers
    depends = {each.text for each in ET.fromstring(files["package.xml"]).iter("depend")}
    assert depends == {"diagnostic_msgs", "geometry_msgs", "roscpp", "std_msgs"} | packages


def test_what_other_nodes_have_to_offer_is_listed() -> None:
    effects = "call /lamp : std_srvs/Trigger {}; cancel /arm within 1 sec; set /planner.x to 1"
    files = generate(acting(effects), "ros1")
    assert '{"action server /arm", "arm/status", false},' in files["src/rules.cpp"]
    assert '{"service /lamp", "lamp", true},' in files["src/rules.cpp"]
    assert "- parameter /planner.x: service `/planner/set_parameters`" in files["README.md"]
