"""What stands in a generated package, without ROS."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import pytest

from dslkit.source import SourceFile, Span
from rossmarie import ir
from rossmarie.driver.build import generate
from rossmarie.ir import reactions
from rossmarie.targets import ros1
from rossmarie.targets.ros import names
from support.ros1_cases import vehicle


def with_effect(effect: reactions.Effect) -> ir.Machine:
    """The vehicle, where the first task does something else."""
    machine = vehicle()
    first, *others = machine.reactions.tasks
    tasks = (replace(first, effect=effect), *others)
    return replace(machine, reactions=replace(machine.reactions, tasks=tasks))


def test_the_package_is_complete() -> None:
    files = generate(vehicle(), "ros1")
    assert {
        "package.xml",
        "CMakeLists.txt",
        "README.md",
        "config/parameters.yaml",
        "launch/vehicle_safety.launch",
        "msg/Verdict.msg",
        "srv/Reset.srv",
        "src/vehicle_monitor.c",
        "src/vehicle_reactor.c",
        "src/main.cpp",
        "src/hooks.cpp",
    } <= set(files)


def test_the_same_rules_give_the_same_files() -> None:
    assert generate(vehicle(), "ros1") == generate(vehicle(), "ros1")


def test_packages_of_all_messages_are_named() -> None:
    files = generate(vehicle(), "ros1")
    depends = {each.text for each in ET.fromstring(files["package.xml"]).iter("depend")}
    assert depends == {
        "actionlib_msgs",
        "topic_tools",
        "diagnostic_msgs",
        "geometry_msgs",
        "roscpp",
        "sensor_msgs",
        "std_msgs",
        "std_srvs",
    }
    for package in depends:
        assert f"\n  {package}" in files["CMakeLists.txt"]


def test_the_planner_is_launched_behind_the_filter() -> None:
    launch = ET.fromstring(generate(vehicle(), "ros1")["launch/vehicle_safety.launch"])
    group = launch.find("group")
    assert group is not None
    assert [dict(each.attrib) for each in group.iter("remap")] == [
        {"from": "/cmd_vel", "to": "/unfil_cmd_vel"}
    ]
    assert [each.attrib["respawn"] for each in launch.iter("node")] == ["true"]


def test_a_rules_file_with_an_odd_name_gives_valid_xml() -> None:
    machine = vehicle()
    odd = SourceFile("a--b & <c>.ross", "text")
    rules = tuple(replace(rule, span=Span(odd, 0, 4)) for rule in machine.rules)
    files = generate(replace(machine, rules=rules), "ros1")
    for name, text in files.items():
        if name.endswith((".xml", ".launch")):
            ET.fromstring(text)


@pytest.mark.parametrize(
    ("topic", "source"),
    [
        ("/cmd_vel", "/unfil_cmd_vel"),
        ("/robot/cmd_vel", "/robot/unfil_cmd_vel"),
        ("cmd_vel", "unfil_cmd_vel"),
    ],
)
def test_commands_come_from_a_topic_beside(topic: str, source: str) -> None:
    assert names.unfiltered(topic) == source


@pytest.mark.parametrize(
    ("rules", "package"),
    [("std_msgs", "std_msgs_safety"), ("switch", "switch_safety"), ("2 Räder", "n2_rader_safety")],
)
def test_a_package_is_called_like_its_rules_but_like_no_other(rules: str, package: str) -> None:
    assert names.package(replace(vehicle(), name=rules)) == package


def test_command_topics_that_differ_only_in_signs_differ_in_cpp() -> None:
    machine = vehicle()
    (command,) = machine.reactions.commands
    topics = ("/a/cmd_vel", "/a_cmd_vel", "/all", "/a/cmd/vel2")
    commands = tuple(replace(command, topic=topic) for topic in topics)
    machine = replace(machine, reactions=replace(machine.reactions, commands=commands))
    for given in (names.command_members(machine), names.command_classes(machine)):
        assert len(set(given)) == len(topics)
    assert "all" not in names.command_members(machine)


def test_what_the_node_cannot_do_is_refused() -> None:
    switch = reactions.SwitchControllers("/controller_manager", ("a",), ("b",), 10**9)
    (found,) = ros1.unsupported(with_effect(switch))
    assert (found.code, found.title) == (
        "ROSS503",
        "the target ros1 cannot do `switch /controller_manager`",
    )
    assert list(ros1.unsupported(vehicle())) == []


def test_rules_that_do_nothing_are_refused() -> None:
    machine = replace(vehicle(), reactions=ir.NO_REACTIONS)
    assert [found.code for found in ros1.unsupported(machine)] == ["ROSS504"]


def test_values_of_messages_are_assigned_by_their_kind() -> None:
    assignments = (
        reactions.Assignment(("name",), ("a", 'b"')),
        reactions.Assignment(("position",), (1.0, -2.5)),
        reactions.Assignment(("header", "frame_id"), "base"),
    )
    publish = reactions.Publish("/j", "sensor_msgs/JointState", assignments, None, None)
    text = generate(with_effect(publish), "ros1")["src/actions.h"]
    assert 'message.name = {"a", "b\\042"};' in text
    assert "assign(message.position, {1.0, -2.5});" in text
    assert 'message.header.frame_id = "base";' in text


def test_no_line_of_the_generated_text_ends_in_a_blank(tmp_path: Path) -> None:
    for name, text in generate(vehicle(), "ros1").items():
        assert [line for line in text.splitlines() if line != line.rstrip()] == [], name
