"""Rules and skills in a scene: what there is to take, what rules ask for, what they read."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import pytest

from dslkit.diagnostics import Diagnostic
from support import command_line
from support.robots import EXAMPLE, codes, found_with, put_example

RULES = EXAMPLE / "whiteboard.ross"
SCENE = EXAMPLE / "office.turtle"
HEAD = """
skills "skills.json";
input force = topic /wrench : geometry_msgs/WrenchStamped .wrench.force timeout 0.1 sec;
action halt { block /cmd_vel : geometry_msgs/Twist; }
input most = doing Wipe.Board.Withstands;
"""
STRONG, GLASS = "office:Withstands 200.0", "office:Withstands 30.0"


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return put_example(tmp_path_factory.mktemp("robot"))


def in_scene(robot: Path, rule: str, *changes: tuple[str, str]) -> list[Diagnostic]:
    """The findings about a scene, on a rule beside the skills of the example."""
    text = SCENE.read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    scene = robot / "changed.turtle"
    scene.write_text(text, encoding="utf-8")
    found = found_with(robot, f"{HEAD}rule it: if {rule} then {{ halt; }};", scene)
    return [each for each in found if each.code in ("CHK105", "CHK106", "CHK205", "CHK303")]


def test_the_example_is_fine_in_its_scene() -> None:
    done = command_line.run("crosscheck", "check", "--scene", SCENE, RULES)
    assert (done.returncode, done.stdout) == (0, "no errors in 1 file\n")


@pytest.mark.parametrize(
    ("rule", "is_stale"),
    [
        ("doing Wipe and norm(force) > most", True),
        ("doing Wipe(Board: GlassBoard) and norm(force) > most", False),
        ("doing Wipe(Board: Whiteboard) and norm(force) > most", True),
        ("doing Reach and norm(force) > most", False),
        ("norm(force) > most while doing Wipe", True),
        ("norm(force) > 10 N and doing Wipe", False),
    ],
)
def test_a_number_is_missed_where_the_rule_is_stale_without_it(
    robot: Path, rule: str, is_stale: bool
) -> None:
    found = in_scene(robot, rule, (f" ; {STRONG}", ""))
    assert codes(tuple(found)) == ["CHK106"] * is_stale
    for each in found:
        assert each.primary.span.text == "office:Whiteboard-5"
        assert [label.span.text for label in each.labels] == ["it"]
    assert in_scene(robot, rule) == []


@pytest.mark.parametrize(
    ("values", "problem"),
    [
        ("office:Withstands 200.0 , 30.0", "no single"),
        ('office:Withstands "much"', "no single"),
        ("office:Withstands 200.0 , 2e2", None),
        ("office:Withstands 200", None),
    ],
)
def test_a_number_is_one_number(robot: Path, values: str, problem: str | None) -> None:
    found = in_scene(robot, "doing Wipe and norm(force) > most", (STRONG, values))
    assert [problem in each.title for each in found if problem] == [True] * (problem is not None)
    assert bool(found) is (problem is not None)


def test_each_individual_that_can_be_taken_is_looked_at(robot: Path) -> None:
    rule = "doing Wipe and norm(force) > most"
    found = in_scene(robot, rule, (f" ; {STRONG}", ""), (f" ; {GLASS}", ""))
    assert [each.primary.span.text for each in found] == [
        "office:GlassBoard-6",
        "office:Whiteboard-5",
    ]


def test_a_class_without_an_individual_is_reported_once_and_what_there_is_instead(
    robot: Path,
) -> None:
    gone = ("office:GlassBoard-6", "office:Whiteboard-6"), (", office:GlassBoard", "")
    asked = "doing Wipe(Board: GlassBoard)"
    (found,) = in_scene(robot, f"{asked} or {asked}", *gone)[:1]
    assert (found.code, found.primary.span.text) == ("CHK105", asked)
    assert "`office.Whiteboard`" in (found.help or "")
    assert in_scene(robot, "doing Wipe(Board: Whiteboard)", *gone) == []


def test_skills_with_nothing_to_take_are_reported_together_and_no_rule_with_them(
    robot: Path,
) -> None:
    no_sponge = (
        "office:Sponge-4 a owl:NamedIndividual , office:Sponge",
        "skiros:Product-4 a skiros:Product",
    )
    link = ("office:Sponge-4", "skiros:Product-4")
    (found,) = in_scene(robot, "doing Wipe(Sponge: Sponge)", no_sponge, link)
    assert found.code == "CHK205"
    assert found.title.startswith("`Erase` and `Wipe` cannot start")


def test_what_is_wrong_with_a_scene_by_itself_is_reported_as_well(robot: Path) -> None:
    scene = robot / "wrong.turtle"
    scene.write_text(SCENE.read_text().replace(", office:Sponge", ", office:Spunge"))
    done = command_line.run("crosscheck", "check", "--scene", scene, RULES, "--format", "sarif")
    assert done.returncode == 1
    (run,) = json.loads(done.stdout)["runs"]
    assert {"EZS601", "CHK205"} <= {each["ruleId"] for each in run["results"]}


DEEP = "@prefix a: <http://a/> .\na:b a:c " + "[ a:d " * 5000 + "]" * 5000 + " ."
HOSTILE = {
    "bytes.turtle": b"\xff\xfe\x00a",
    "deep.turtle": DEEP.encode(),
    "large.turtle": b"#" * (65 << 20),
    "scene.csv": b"secret,hunter2",
    "half.turtle": b"<http://a> a",
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_scene_that_is_none_is_an_error_at_its_place(name: str, tmp_path: Path) -> None:
    scene = tmp_path / name
    scene.write_bytes(HOSTILE[name])
    done = command_line.run("crosscheck", "check", "--scene", scene, RULES)
    assert done.returncode == 1, done.stdout + done.stderr
    assert "error[EZS10" in done.stdout
    assert f"--> {scene}" in done.stdout
    assert "hunter2" not in done.stdout + done.stderr
    assert "Traceback" not in done.stdout + done.stderr


def test_a_scene_that_is_not_there_is_said_in_one_line(tmp_path: Path) -> None:
    for scene, reason in (tmp_path / "no.turtle", "no such file"), (tmp_path, ""):
        done = command_line.run("crosscheck", "check", "--scene", scene, RULES)
        assert done.returncode in (1, 2)
        assert reason in (done.stdout + done.stderr).lower()
        assert "Traceback" not in done.stdout + done.stderr


def test_skills_without_an_ontology_have_no_scene(tmp_path: Path) -> None:
    rules = RULES.parents[2] / "tests" / "fixtures" / "skillful" / "skillful.ross"
    done = command_line.run("crosscheck", "check", "--scene", SCENE, rules)
    assert done.returncode == 1
    assert "error[CHK303]" in done.stdout


def test_nothing_of_a_source_that_is_no_ontology_is_shown(tmp_path: Path) -> None:
    robot = put_example(tmp_path)
    secret = tmp_path / "secret.json"
    secret.write_text('{"password": "hunter2"')
    skills = robot / "skills.json"
    found = json.loads(skills.read_text())
    digest = hashlib.sha256(secret.read_bytes()).hexdigest()
    found["sources"].append({"path": "../secret.json", "sha256": digest})
    skills.write_text(json.dumps(found))
    done = command_line.run("crosscheck", "check", "--scene", SCENE, robot / "whiteboard.ross")
    assert done.returncode == 1
    assert "error[CHK303]" in done.stdout
    assert "hunter2" not in done.stdout + done.stderr
