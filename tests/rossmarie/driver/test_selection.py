"""Categories of rules, and monitors of those that a selection of categories holds."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import rossmarie
from rossmarie.driver import RulesError, compile_file
from rossmarie.driver.build import build_files
from rossmarie.driver.report import safety_file
from rossmarie.ir import Category, is_selected
from rossmarie.ir.serial import machine_from_json, machine_to_json
from rossmarie.report.safety import open_points, render_safety_file
from support import command_line

RULES = """
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec;
input near = topic /near : std_msgs/Bool timeout 0.5 sec;
action creep { publish /lamp : std_msgs/Bool { data = true; } at 1 Hz; }
action stop { publish /lamp : std_msgs/Bool { data = false; } at 2 Hz; }
rule fast: if speed > 1 m/s then { creep; } category operation task independent feedback 2 per sec;
rule close: if near unless fast then { stop; } category human task dependent;
if speed > 2 m/s then { stop; } category human;
rule jumping: if rate(speed) > 3 m/s^2 unless close then { creep; }
    category environment task dependent;
rule unfiled: if speed > 4 m/s then { stop; };
priority jumping over close over fast;
"""


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    path = tmp_path / "rules.ross"
    path.write_text(RULES)
    return path


def names(rules: Path, *only: Category) -> list[str]:
    return [rule.name for rule in compile_file(rules, only=only).machine.rules]


def test_all_rules_are_kept_without_a_selection(rules: Path) -> None:
    machine = compile_file(rules).machine
    assert machine.left_out is None
    assert [rule.categories for rule in machine.rules] == [
        (Category.OPERATION, Category.TASK_INDEPENDENT),
        (Category.HUMAN, Category.TASK_DEPENDENT),
        (Category.HUMAN,),
        (Category.ENVIRONMENT, Category.TASK_DEPENDENT),
        (),
    ]


def test_subjects_are_alternatives_and_the_task_is_a_second_demand(rules: Path) -> None:
    assert names(rules, Category.HUMAN) == ["close", "rule_3"]
    assert names(rules, Category.OPERATION, Category.ENVIRONMENT) == ["fast", "jumping"]
    assert names(rules, Category.TASK_DEPENDENT) == ["close", "jumping"]
    assert names(rules, Category.HUMAN, Category.TASK_DEPENDENT) == ["close"]
    assert names(rules, *Category) == ["fast", "close", "jumping"]
    assert not is_selected((), [Category.HUMAN])
    assert is_selected((), [])


def test_what_belongs_to_a_rule_stays_with_it(rules: Path) -> None:
    whole = compile_file(rules).machine
    part = compile_file(rules, only=[Category.TASK_DEPENDENT]).machine
    assert part.left_out is not None
    assert part.left_out.rules == ("fast", "rule_3", "unfiled")
    assert [plan.unless for plan in part.reactions.plans] == [(), (0,)]
    assert part.reactions.order == (1, 0)
    assert part.reactions.priorities == ((1, 0),)
    kept = compile_file(rules, only=[Category.OPERATION]).machine.rules[0]
    assert kept.feedback == whole.rules[0].feedback
    assert kept.contract == whole.rules[0].contract
    assert [
        used.name for used in compile_file(rules, only=[Category.OPERATION]).machine.inputs
    ] == ["speed"]


def test_a_selection_survives_as_json(rules: Path) -> None:
    for only in ([], [Category.HUMAN]):
        machine = compile_file(rules, only=only).machine
        read = machine_from_json(machine_to_json(machine))
        assert read.left_out == machine.left_out
        assert [rule.categories for rule in read.rules] == [
            rule.categories for rule in machine.rules
        ]


def test_orders_that_name_a_rule_that_is_left_out_are_reported(rules: Path) -> None:
    found = compile_file(rules, only=[Category.TASK_DEPENDENT]).warnings
    lines = [each.primary.span.begin.line for each in found if each.code == "ROSS252"]
    assert lines == [7, 12]
    assert [each.code for each in compile_file(rules).warnings if each.code == "ROSS252"] == []


def test_an_empty_selection_is_an_error_that_tells_the_categories(rules: Path) -> None:
    with pytest.raises(RulesError) as refused:
        compile_file(rules, only=[Category.ENVIRONMENT, Category.TASK_INDEPENDENT])
    (found,) = refused.value.diagnostics
    assert found.code == "ROSS251"
    assert found.title == "no rule is `environment` and `task independent`"
    assert found.primary.text == (
        "the rules have: operation (1), human (2), environment (1), task dependent (2), "
        "task independent (1)"
    )


def test_monitors_are_of_a_selection(rules: Path) -> None:
    with pytest.warns(RuntimeWarning, match="is left out") as reported:
        monitor = rossmarie.load(rules, only=["human"])
    assert len(reported) == 3
    assert monitor.rules == ("close", "rule_3")
    monitor.update(0, {"speed": 3.0, "near": 0.0})
    assert monitor.active == ("rule_3",)
    with pytest.raises(ValueError, match="'robot' is not a valid Category"):
        rossmarie.load(rules, only=["robot"])


def test_the_safety_file_groups_by_category(rules: Path) -> None:
    content, _ = safety_file(rules, tool="test", date="2026-01-01")
    page = render_safety_file(content)
    places = [page.index(f"<h3>{each}</h3>") for each in ("Operation", "Human", "Environment")]
    assert places == sorted(places)
    assert places[1] < page.index('id="rule-close"') < page.index('id="rule-rule_3"') < places[2]
    assert page.index("<h3>Without a category</h3>") < page.index('id="rule-unfiled"')
    assert "Its category: human and task dependent." in page
    part, _ = safety_file(rules, tool="test", date="2026-01-01", only=[Category.HUMAN])
    assert "Only rules of human are here: fast, jumping and unfiled left out." in open_points(part)


def test_the_node_tells_the_categories_of_a_verdict(rules: Path, tmp_path: Path) -> None:
    build_files(rules, "ros1", tmp_path / "out", only=[Category.HUMAN])
    text = (tmp_path / "out" / "src" / "rules.cpp").read_text()
    assert '{"human", "task dependent"}),' in text
    assert "string[] categories" in (tmp_path / "out" / "msg" / "Verdict.msg").read_text()


def test_commands_take_categories(rules: Path, tmp_path: Path) -> None:
    table = tmp_path / "ride.csv"
    table.write_text("time,speed,near\n0,3,0\n1,0,1\n")
    out = tmp_path / "out"
    done = command_line.run("rossmarie", "replay", "--only", "human", rules, table, "--out", out)
    assert done.returncode == 0, done.stderr
    header, *lines = map(json.loads, (out / "verdicts.jsonl").read_text().splitlines())
    assert header["rules"] == ["close", "rule_3"]
    assert header["left_out"] == ["fast", "jumping", "unfiled"]
    verdicts = [line for line in lines if line["type"] == "verdict"]
    assert {line["rule"]: line["categories"] for line in verdicts} == {
        "close": ["human", "task dependent"],
        "rule_3": ["human"],
    }
    done = command_line.run("rossmarie", "check", "--only", "robot", rules)
    assert done.returncode == 2
    assert "`operation`, `human`" in done.stderr
    done = command_line.run(
        "rossmarie", "build", "--only", "Task  Dependent", rules, "-o", tmp_path / "c"
    )
    assert done.returncode == 0, done.stderr
    assert "left out: fast, rule_3, unfiled" in done.stdout
