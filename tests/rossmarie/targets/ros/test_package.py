"""The content of a generated package of either generation, without ROS."""

from __future__ import annotations

import shutil
import subprocess
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import pytest

from dslkit.source import SourceFile, Span
from rossmarie import ir
from rossmarie.driver.build import TARGETS, generate
from rossmarie.ir import reactions
from rossmarie.targets.ros import names
from support.c_compiler import write
from support.compiled import machine_of
from support.live_cases import acting, vehicle

GENERATIONS = ("ros1", "ros2")
RULES = """
action halt { block /cmd_vel : geometry_msgs/TwistStamped; }
input force = topic /ft : geometry_msgs/Wrench .force timeout 0.1 sec
rule touched: if norm(force) > 10 N then { halt; };
"""


@pytest.fixture(params=GENERATIONS)
def generation(request: pytest.FixtureRequest) -> str:
    """Each generation."""
    return str(request.param)


def with_effect(effect: reactions.Effect) -> ir.Machine:
    """The vehicle, where the first task does something else."""
    machine = vehicle()
    first, *others = machine.reactions.tasks
    tasks = (replace(first, effect=effect), *others)
    return replace(machine, reactions=replace(machine.reactions, tasks=tasks))


def test_the_package_is_complete(generation: str) -> None:
    files = generate(vehicle(generation), generation)
    assert {
        "package.xml",
        "CMakeLists.txt",
        "README.md",
        "config/parameters.yaml",
        "msg/Verdict.msg",
        "srv/Reset.srv",
        "src/vehicle_monitor.c",
        "src/vehicle_reactor.c",
        "src/rules.cpp",
        "src/hooks.cpp",
        "test/test_reactions.c",
    } <= set(files)


def test_what_both_generations_share_is_the_same_text() -> None:
    machine = machine_of(RULES)
    one, other = (generate(machine, generation) for generation in GENERATIONS)
    shared = {name for name in one if other.get(name) == one[name]}
    assert {
        "runtime/guard.h",
        "runtime/filter.h",
        "runtime/task.h",
        "runtime/reporting.cpp",
    } <= shared


def test_the_same_rules_give_the_same_files(generation: str) -> None:
    machine = vehicle(generation)
    assert generate(machine, generation) == generate(machine, generation)


def test_command_topics_that_differ_only_in_signs_differ_in_cpp() -> None:
    machine = vehicle()
    command, _ = machine.reactions.commands
    topics = ("/a/cmd_vel", "/a_cmd_vel", "/all", "/a/cmd/vel2")
    commands = tuple(replace(command, topic=topic) for topic in topics)
    machine = replace(machine, reactions=replace(machine.reactions, commands=commands))
    assert len(set(names.command_classes(machine))) == len(topics)


def test_tasks_that_need_one_server_share_what_is_known_of_its_goals() -> None:
    effects = "cancel /arm within 1 sec; cancel /arm within 2 sec; cancel /a_rm within 1 sec"
    text = "".join(generate(acting(effects), "ros1")["src/rules.cpp"].split())
    assert text.count("std::make_shared<Goals>") == 2
    assert text.count("CancelTask>(action_server_arm,") == 2
    assert text.count("CancelTask>(action_server_a_rm,") == 1


@pytest.mark.parametrize(
    ("value", "given"), [("true", "true"), ("3", "3.0"), ('"fast"', 'std::string("fast")')]
)
def test_a_parameter_is_set_to_a_value_of_its_kind(value: str, given: str) -> None:
    text = generate(acting(f"set /planner.mode to {value}"), "ros1")["src/rules.cpp"]
    assert f"SetTask>(parameter_planner_mode,{given}," in "".join(text.split())


def test_values_of_messages_are_assigned_by_their_kind() -> None:
    assignments = (
        reactions.Assignment(("name",), ("a", 'b"')),
        reactions.Assignment(("position",), (1.0, -2.5)),
        reactions.Assignment(("header", "frame_id"), "base"),
    )
    publish = reactions.Publish("/j", "sensor_msgs/JointState", assignments, None, None)
    text = generate(with_effect(publish), "ros1")["src/rules.cpp"]
    assert 'message.name = {"a", "b\\042"};' in text
    assert "assign(message.position, {1.0, -2.5});" in text
    assert 'message.header.frame_id = "base";' in text


def test_a_rules_file_with_an_odd_name_gives_valid_xml(generation: str) -> None:
    machine = vehicle(generation)
    odd = SourceFile("a--b & <c>.ross", "text")
    rules = tuple(replace(rule, span=Span(odd, 0, 4)) for rule in machine.rules)
    files = generate(replace(machine, rules=rules), generation)
    for name, text in files.items():
        if name.endswith((".xml", ".launch")):
            ET.fromstring(text)
        if name.endswith(".py"):
            compile(text, name, "exec")


def test_rules_that_do_nothing_are_refused(generation: str) -> None:
    machine = replace(vehicle(), reactions=ir.NO_REACTIONS)
    assert [found.code for found in TARGETS[generation].unsupported(machine)] == ["ROSS504"]


def test_no_line_of_the_generated_text_ends_in_a_blank(generation: str) -> None:
    for name, text in generate(vehicle(generation), generation).items():
        assert [line for line in text.splitlines() if line != line.rstrip()] == [], name


def test_the_generated_test_passes_and_sees_bounds_that_are_too_wide(
    generation: str, tmp_path: Path
) -> None:
    files = generate(vehicle(generation), generation)
    write(files, tmp_path)
    assert _run_reactions(tmp_path) == 0
    reactor = tmp_path / "src" / "vehicle_reactor.c"
    text = reactor.read_text(encoding="utf-8")
    assert "-0.2" in text
    reactor.write_text(text.replace("-0.2", "-0.25"), encoding="utf-8")
    assert _run_reactions(tmp_path) == 1


def test_the_generated_test_of_rules_without_commands_passes(
    generation: str, tmp_path: Path
) -> None:
    write(generate(replace(acting('log info "touched"'), name="vehicle"), generation), tmp_path)
    assert _run_reactions(tmp_path) == 0


def _run_reactions(package: Path) -> int:
    """Compile the generated test as the package does, and run it."""
    compiler = shutil.which("cc")
    assert compiler is not None
    program = package / "test_reactions"
    sources = [package / "test" / "test_reactions.c", package / "src" / "vehicle_reactor.c"]
    options = ["-std=c99", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror"]
    include = f"-I{package / 'src'}"
    command: list[str | Path] = [compiler, *options, include, *sources, "-lm", "-o", program]
    subprocess.run(command, check=True)
    return subprocess.run([program], capture_output=True).returncode


def test_s55_an_element_by_a_declared_name_rests_on_the_length(generation: str) -> None:
    machine = machine_of(
        "action halt { block /cmd_vel : geometry_msgs/Twist; }\n"
        "input efforts = topic /effort_states : std_msgs/Float64MultiArray .data\n"
        '    names ["shoulder", "elbow"] timeout 0.1 sec;\n'
        'rule heavy: if efforts["elbow"] > 30 then { halt; };'
    )
    rules = generate(machine, generation)["src/rules.cpp"]
    assert "element(message.data, place_among(1, 2, message.data))" in rules
