"""`crosscheck weave`: the guards of skills."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from crosscheck.robot import load
from crosscheck.weaving import Woven, text_of, woven
from dslkit.ownership import is_own
from ezskiros.context.guards import Guards, read_guards
from support import command_line
from support.golden import assert_golden
from support.robots import EXAMPLE, put_example

RULES = EXAMPLE / "whiteboard.ross"
HEAD = """
skills "skills.json";
input force = topic /wrench : geometry_msgs/WrenchStamped .wrench.force timeout 0.1 sec;
action retract { cancel /arm_controller/follow_joint_trajectory within 0.5 sec else halt; }
action halt { block /cmd_vel : geometry_msgs/Twist; }
action slow { limit /cmd_vel : geometry_msgs/Twist { linear.x in [-0.5, 0.5] m/s; }; }
"""


def guards_with(robot: Path, rules: str) -> Woven:
    """The guards of the skills of the example, with these rules."""
    path = robot / "rules.ross"
    path.write_text(HEAD + rules)
    found = load(path)
    assert found.robot is not None, [each.title for each in found.diagnostics]
    return woven(found.robot)


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return put_example(tmp_path_factory.mktemp("robot"))


def test_the_guards_of_the_example(tmp_path: Path, *, bless: bool) -> None:
    out = tmp_path / "guards.json"
    done = command_line.run("crosscheck", "weave", RULES, "-o", out)
    assert (done.returncode, done.stdout) == (0, f"wrote {out}\n"), done.stderr
    assert done.stderr == (
        "crosscheck: Reach and Wipe will not wait for `contact`, because it depends on the "
        "running skills\n"
        "crosscheck: Reach and Wipe will not wait for `contact_while_Wipe`, because it "
        "depends on the running skills\n"
    )
    digest = json.loads((EXAMPLE / "skills.json").read_text())["digest"]
    text = out.read_text().replace(digest, "DIGEST")
    golden = Path(__file__).parent / "golden" / "whiteboard_guards.json"
    assert_golden(golden, text, bless=bless)


def test_the_other_language_reads_what_is_written(robot: Path, tmp_path: Path) -> None:
    found = guards_with(
        robot,
        "rule a: if norm(force) > 5 N then { retract; halt; };"
        "rule b: if norm(force) > 6 N then { halt; };",
    )
    path = tmp_path / "guards.json"
    path.write_text(text_of(found))
    read = read_guards(path)
    assert isinstance(read, Guards)
    assert (read.digest, read.node, read.rules) == (
        found.digest,
        found.node,
        frozenset(found.rules),
    )
    assert read.guards == {"Drive": ("a", "b"), "Reach": ("a",), "Wipe": ("a",)}
    assert (read.topic, read.type) == ("rules_safety/state", "rules_safety/State")


def test_what_takes_nothing_is_waited_for_by_nobody(robot: Path) -> None:
    found = guards_with(robot, "rule a: if norm(force) > 5 N then { slow; };")
    assert found.guards == {"Drive": [], "Reach": [], "Wipe": []}
    assert found.left_out == {}


def test_an_escalation_need_not_come(robot: Path) -> None:
    found = guards_with(robot, "rule a: if norm(force) > 5 N then { retract; };")
    assert found.guards == {"Drive": [], "Reach": ["a"], "Wipe": ["a"]}


@pytest.mark.parametrize(
    "rule",
    [
        "rule a: if norm(force) > 5 N and doing Drive then { halt; };",
        "rule a: if norm(force) > 5 N and ahead Drive then { halt; };",
        "rule a: if norm(force) > 5 N while doing Wipe then { halt; };",
        "rule a: if norm(force) > 5 N then { halt; } unless doing Wipe;",
        "rule a: if norm(force) > 5 N then { halt; } clear when not doing Wipe;",
        "rule a: if norm(force) > 5 N and once doing Wipe within 2 sec then { halt; };",
    ],
)
def test_rules_that_ask_about_skills_are_left_out(robot: Path, rule: str) -> None:
    found = guards_with(robot, rule)
    assert found.left_out["a"] == ["Drive"]
    assert "a" not in found.guards["Drive"]


def test_a_rule_that_reads_a_number_of_a_skill_is_left_out() -> None:
    """Its condition asks with what a skill runs, and not which."""
    fixture = EXAMPLE.parents[1] / "tests" / "fixtures" / "skillful" / "skillful.ross"
    found = load(fixture).robot
    assert found is not None
    assert woven(found).guards == {"Push": []}


def test_nothing_else_is_written_over(robot: Path) -> None:
    def weave(out: str) -> tuple[int, str]:
        done = command_line.run("crosscheck", "weave", "whiteboard.ross", "-o", out, folder=robot)
        return done.returncode, done.stderr

    before = {path: path.read_bytes() for path in robot.glob("*.*")}
    for name in ("whiteboard.ross", "skills.json"):
        code, said = weave(name)
        assert code == 2
        assert f"{name} is there, and crosscheck did not write it" in said
    assert {path: path.read_bytes() for path in before} == before
    assert weave("guards.json")[0] == 0
    (robot / "guards.json").write_text((robot / "guards.json").read_text() + "\n")
    assert weave("guards.json")[0] == 0
    assert is_own((robot / "guards.json").read_bytes(), "crosscheck")
    assert not (robot / "guards.json").read_text().endswith("\n\n")
    code, said = weave("nowhere/guards.json")
    assert code == 2
    assert "cannot write nowhere/guards.json: " in said


def test_nothing_is_written_of_rules_with_errors(robot: Path) -> None:
    (robot / "wrong.ross").write_text("action stop")
    done = command_line.run("crosscheck", "weave", "wrong.ross", "-o", "w.json", folder=robot)
    assert done.returncode == 1
    assert "error[" in done.stdout
    assert not (robot / "w.json").exists()
