"""Findings on files that are imported under names, and what else tells of such files."""

from __future__ import annotations

import dataclasses
import json
import typing
from pathlib import Path

import pytest

from dslkit.diagnostics import Diagnostic
from rossmarie.check.instances.rewrite import KINDS
from rossmarie.driver import check_file
from rossmarie.driver.analyze import analyze_file
from rossmarie.driver.formatting import format_text
from rossmarie.driver.generating import generate_tests
from rossmarie.driver.pipeline import compile_file
from rossmarie.driver.rules_file import rules_file
from rossmarie.driver.testing import run_tests
from rossmarie.driver.workspace import MOST_INSTANCES
from rossmarie.syntax import ast
from rossmarie.syntax.ast import effects, expressions, imports, items, tests, zones

LIBRARY = """\
parameter gap in m;
parameter scan = topic /scan;
action stop { block /cmd_vel : geometry_msgs/Twist; }
input ranges = topic scan : std_msgs/Float64MultiArray .data in m timeout 0.3 sec;
entity near { stop : min(ranges) < gap; }
rule tooNear: if near.stop then { stop; };
"""
FRONT = 'import "library.ross" with gap = 1 m, scan = /front/scan as front;\n'
REAR = 'import "library.ross" with gap = 2 m, scan = /rear/scan as rear;\n'


@pytest.fixture
def main(tmp_path: Path) -> Path:
    (tmp_path / "library.ross").write_text(LIBRARY)
    (tmp_path / "main.ross").write_text(FRONT + REAR)
    return tmp_path / "main.ross"


def found_in(main: Path, text: str, library: str = LIBRARY) -> tuple[Diagnostic, ...]:
    main.write_text(text)
    main.with_name("library.ross").write_text(library)
    return check_file(main).diagnostics


# --- messages --------------------------------------------------------------------------------


def test_a_mistake_in_the_file_is_reported_once_with_all_imports(main: Path) -> None:
    (found,) = found_in(main, FRONT + REAR, LIBRARY.replace("{ stop; }", "{ stopp; }"))
    assert Path(found.primary.span.file.path).name == "library.ross"
    assert "`stopp`" in found.title
    assert found.help == "did you mean `stop`?"
    assert found.fix is not None
    assert [edit.replacement for edit in found.fix.edits] == ["stop"]
    reported = [(label.span.begin.line, label.text) for label in found.labels[1:]]
    assert reported == [(1, "imported here as `front`"), (2, "imported here as `rear`")]


def test_a_mistake_of_one_instance_names_its_import(main: Path) -> None:
    library = LIBRARY.replace("min(ranges)", "ranges[0] > 3 m and min(ranges)").replace(
        "gap in m", "gap = 1 m / zero"
    )
    library = f"parameter zero = 1;\n{library}"
    text = 'import "library.ross" with zero = 0 as bad;\nimport "library.ross" as good;'
    (found,) = found_in(main, text, library)
    assert [label.text for label in found.labels if "import" in label.text] == [
        "imported here as `bad`"
    ]


def test_outside_the_name_of_the_import_comes_first(main: Path) -> None:
    text = f"{FRONT}rule more: if front.near.stop then {{ front.stpo; }};"
    (found,) = found_in(main, text)
    assert "`front.stpo`" in found.title
    assert found.help == "did you mean `front.stop`?"
    assert found.fix is not None
    assert found.fix.edits[0].replacement == "front.stop"


def test_a_name_without_its_import_is_found(main: Path) -> None:
    (found,) = found_in(
        main, f"{FRONT}rule more: if min(front_rangess) < 1 m then {{ front.stop; }};"
    )
    assert found.help == "did you mean `front.ranges`?"


def test_a_mistake_of_syntax_is_reported_once(main: Path) -> None:
    (found,) = found_in(main, FRONT + REAR, LIBRARY.replace("gap in m", "gap in"))
    assert found.code.startswith("ROSS0")


def test_queries_about_rules_name_the_import(main: Path) -> None:
    library = LIBRARY.replace("min(ranges) < gap", "min(ranges) < gap and min(ranges) > 4 m")
    main.with_name("library.ross").write_text(library)
    found = [each for each in analyze_file(main).diagnostics if each.code.startswith("ROSS7")]
    labels = [label.text for each in found for label in each.labels]
    assert "imported here as `front`" in labels
    assert "imported here as `rear`" in labels
    assert not any("front_" in each.title for each in found)


# --- limits ----------------------------------------------------------------------------------


def test_files_that_import_each_other_under_names_end(tmp_path: Path) -> None:
    (tmp_path / "a.ross").write_text('import "b.ross" as b;\n')
    (tmp_path / "b.ross").write_text('import "a.ross" as a;\n')
    found = check_file(tmp_path / "a.ross").diagnostics
    assert [(each.code, Path(each.primary.span.file.path).name) for each in found] == [
        ("ROSS157", "b.ross")
    ]


def test_there_are_not_more_instances_than_the_limit(tmp_path: Path) -> None:
    for number in range(12):
        text = f'import "{number + 1}.ross" as a;\nimport "{number + 1}.ross" as b;'
        (tmp_path / f"{number}.ross").write_text(text)
    (tmp_path / "12.ross").write_text(LIBRARY)
    result = check_file(tmp_path / "0.ross")
    assert {each.code for each in result.diagnostics if each.code != "ROSS154"} == {"ROSS157"}
    assert len(result.modules) <= MOST_INSTANCES + 1


# --- what else tells of them -----------------------------------------------------------------


def test_every_name_of_a_node_is_accounted_for() -> None:
    """A node with a name that belongs to a set of the program has to be in `KINDS`."""
    others = {
        ast.Call: {"function"},
        ast.Condition: {"name"},
        ast.Diagnose: {"level"},
        ast.Doing: {"skill"},
        ast.FieldPath: {"steps"},
        ast.FrameDeclaration: {"alias"},
        ast.Given: {"name", "value"},
        ast.Hazard: {"name"},
        ast.Hook: {"name"},
        ast.Import: {"alias"},
        ast.Input: {"message_type", "path"},
        ast.Keeps: {"place"},
        ast.ListFold: {"function"},
        ast.Log: {"level"},
        ast.Member: {"member"},
        ast.NodeDeclaration: {"name"},
        ast.Parameter: {"default", "tightens"},
        ast.Passed: {"skill", "parameter"},
        ast.ResourceDeclaration: {"name"},
        ast.Rule: {"category", "task", "mitigates"},
        ast.RunTree: {"skill", "afterwards"},
        ast.SendGoal: {"interrupted"},
        ast.CancelGoal: {"interrupted"},
        ast.ServerDeclaration: {"action_type"},
        ast.ServiceDeclaration: {"service_type"},
        ast.SetParameter: {"parameter"},
        ast.Shape: {"word"},
        ast.SettingPath: {"steps"},
        ast.SkillArgument: {"parameter", "kind"},
        ast.SkillNumber: {"skill", "steps"},
        ast.SwitchControllers: {"start", "stop"},
        ast.System: {"name"},
        ast.Target: {"type"},
        ast.TopicDeclaration: {"message_type"},
        ast.TreeArgument: {"parameter"},
        ast.UnitDeclaration: {"message_type", "path"},
    }
    for module in (effects, expressions, imports, items, tests, zones):
        for node in vars(module).values():
            if not isinstance(node, type) or node.__module__ != module.__name__:
                continue
            if not dataclasses.is_dataclass(node):
                continue
            names = {
                name
                for name, type_ in typing.get_type_hints(node, vars(module)).items()
                if _holds_names(type_)
            }
            known = {*KINDS.get(node, {}), *others.get(node, set())}
            assert names == known, node


def _holds_names(type_: object) -> bool:
    return type_ is ast.Name or any(map(_holds_names, typing.get_args(type_)))


def test_a_file_of_several_instances_is_one_source(main: Path) -> None:
    compiled = compile_file(main)
    names = [Path(source.path).name for source in compiled.sources]
    assert names == ["library.ross", "main.ross"]
    reported = json.loads(rules_file(compiled.machine, compiled.sources, main))
    assert [each["path"] for each in reported["sources"]] == ["library.ross", "main.ross"]
    assert [each["name"] for each in reported["rules"]] == ["front_tooNear", "rear_tooNear"]


def test_generated_tests_name_what_instances_have(main: Path) -> None:
    written = generate_tests(main)
    assert "expect front.tooNear active" in written.text
    assert "front_" not in written.text
    written.path.write_text(written.text)
    compiled = compile_file(written.path)
    outcome = run_tests(compiled, compiled.tests)
    assert outcome.ran
    assert not any(ran.found for ran in outcome.ran)


def test_a_misspelt_name_of_an_element_is_guessed(main: Path) -> None:
    main.write_text("""
        parameter elbow = "elbow_joint";
        action stop;
        input joints = topic /j : sensor_msgs/JointState .position in rad timeout 1 sec;
        rule far: if joints[elbwo] > 1 rad then { stop; };
    """)
    (found,) = check_file(main).diagnostics
    assert found.code == "ROSS159"
    assert found.help == "did you mean `elbow`?"


def test_a_frame_with_the_name_of_something_in_an_instance_keeps_it(main: Path) -> None:
    """`front_ranges` is an input to the compiler, and a frame to the user."""
    (main.parent / "system.ross").write_text("""
        system robot {
            frame front_ranges in base_link at [1, 0, 0] m;
            frame rear in base_link at [1, 0, 0] m;
            topic /hand : geometry_msgs/PointStamped from front_ranges;
        }
    """)
    rules = """
        input hand = topic /hand.point in base_link timeout 1 sec;
        rule reach: if norm(hand) > 2 m then { front.stop; };
    """
    main.write_text(FRONT + rules)
    written = generate_tests(main)
    written.path.write_text(written.text)
    compiled = compile_file(written.path)
    outcome = run_tests(compiled, compiled.tests)
    assert not any(ran.found for ran in outcome.ran)
    wrong = "rule apart: if distance(hand, there) > 1 m then { front.stop; };"
    there = "input there = topic /hand.point timeout 1 sec;"
    found = found_in(main, FRONT + rules + there + wrong)
    assert "`front_ranges`" in next(each.title for each in found if each.code == "ROSS275")


def test_long_imports_are_broken_in_front_of_their_parts() -> None:
    short, long = "/a" * 25, "/a" * 40
    text = 'import "library.ross" with gap = 1 m, scan = {}, more = 2 m/s as front;'
    assert format_text(text.format(short)) == (
        f'import "library.ross"\n    with gap = 1 m, scan = {short}, more = 2 m/s\n    as front;\n'
    )
    assert format_text(text.format(long)) == (
        'import "library.ross"\n'
        f"    with gap = 1 m,\n        scan = {long},\n        more = 2 m/s\n"
        "    as front;\n"
    )


def test_parameters_of_the_node_are_the_same_in_c(tmp_path: Path) -> None:
    main = tmp_path / "main.ross"
    main.write_text("""
        parameter gap = 50 cm tightens up;
        parameter braking = 1.2 m/s^2 tightens down;
        action stop;
        input distance = topic /sonar : sensor_msgs/Range .range timeout 0.3 sec;
        input speed = topic /speed : std_msgs/Float64 in m/s timeout 0.3 sec;
        rule near: if distance < gap then { stop; } clear when distance > 2 * gap;
        input around = topic /around : std_msgs/Float64MultiArray .data in m timeout 0.3 sec;
        rule late: if distance < gap + speed * speed / (2 * braking) for 0.2 sec then { stop; };
        rule beside: if any(around < gap + 10 cm) then { stop; };
        test "none" {
            every 0.1 s from 0 s to 1 s distance = 0.7 m, speed = 0 m/s, around = [0.7, 3] m;
            expect near inactive at 1 s;
            expect late inactive at 1 s;
            expect beside inactive from 0 s to 1 s;
        }
        test "tighter" {
            at 0 s gap = 80 cm, braking = 0.6 m/s^2;
            every 0.1 s from 0 s to 1 s distance = 0.7 m, speed = 0 m/s, around = [0.7, 3] m;
            every 0.1 s from 1.1 s to 2 s distance = 1.5 m, speed = 1 m/s;
            expect near active from 0 s to 2 s;
            expect beside active from 0 s to 1 s;
            expect late active at 2 s;
        }
        test "looser" {
            at 0 s gap = 20 cm, braking = 5 m/s^2;
            every 0.1 s from 0 s to 1 s distance = 0.4 m, speed = 0 m/s;
            expect near active from 0 s to 1 s;
        }
    """)
    compiled = compile_file(main)
    outcome = run_tests(compiled, compiled.tests)
    assert outcome.has_c
    assert [each.found for each in outcome.ran] == [(), (), ()]
    generated = generate_tests(main)
    generated.path.write_text(generated.text)
    again = compile_file(generated.path)
    assert not any(ran.found for ran in run_tests(again, again.tests).ran)


def test_two_files_with_the_same_name_inside_ask_for_names_of_their_own(tmp_path: Path) -> None:
    path = tmp_path / "main.ross"
    imports = ("base/separation", "base/tilt")
    path.write_text("".join(f'import "rossmarie/{each}.ross";\n' for each in imports))
    (found,) = check_file(path).diagnostics
    assert found.code == "ROSS105"
    assert "import each file under a different" in str(found.notes[0])
