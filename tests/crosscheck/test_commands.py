"""The command, and how each language asks it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from crosscheck.check import check_robot
from dslkit.diagnostics import Severity
from support import command_line
from support.robots import EXAMPLE, put_example

RULES = EXAMPLE / "whiteboard.ross"
WIDE = """
skills "skills.json";
input force = topic /wrench : geometry_msgs/WrenchStamped .wrench.force timeout 0.1 sec;
action halt { block /cmd_vel : geometry_msgs/Twist; }
rule contact: if norm(force) > 5 N then { halt; } unless doing Wipe;
"""


@pytest.fixture
def wide(tmp_path: Path) -> Path:
    path = put_example(tmp_path) / "wide.ross"
    path.write_text(WIDE)
    return path


def test_the_example_is_fine_and_its_file_of_skills_is_up_to_date(tmp_path: Path) -> None:
    assert command_line.run("crosscheck", "check", RULES).stdout == "no errors in 1 file\n"
    out = tmp_path / "skills.json"
    again = command_line.run("ezskiros", "export", "skills", "-o", out, folder=EXAMPLE)
    assert again.returncode == 0
    reported = [json.loads(path.read_text()) for path in (out, EXAMPLE / "skills.json")]
    assert [skill["name"] for skill in reported[0]["skills"]] == [
        skill["name"] for skill in reported[1]["skills"]
    ]


@pytest.mark.parametrize(
    "command",
    [
        ("crosscheck", "check", "wide.ross"),
        ("rossmarie", "check", "--skills", "wide.ross"),
        ("ezskiros", "check", "--rules", "wide.ross", "skills"),
    ],
    ids=lambda command: command[0],
)
def test_each_language_tells_what_both_together_tell(command: tuple[str, ...], wide: Path) -> None:
    done = command_line.run(*command, folder=wide.parent)
    assert done.returncode == 1, done.stdout + done.stderr
    assert "error[CHK102]" in done.stdout
    assert "wide.ross:5" in done.stdout
    assert "skills/motions.py" in done.stdout
    sarif = command_line.run(*command, "--format", "sarif", folder=wide.parent)
    (run,) = json.loads(sarif.stdout)["runs"]
    assert "CHK102" in [each["ruleId"] for each in run["results"]]


def test_skills_that_have_changed_are_not_looked_at(wide: Path) -> None:
    module = wide.parent / "skills" / "motions.py"
    module.write_text(module.read_text() + "\n# changed\n")
    done = command_line.run("crosscheck", "check", wide)
    assert done.returncode == 1
    assert "CHK" not in done.stdout
    assert "ezskiros export" in done.stdout


def test_a_change_of_a_skill_is_followed_to_trees_and_rules() -> None:
    done = command_line.run("crosscheck", "impact", "Wipe", RULES)
    assert "skill Erase has Wipe in its tree" in done.stdout
    assert "rule contact is not applied while Wipe runs" in done.stdout
    unknown = command_line.run("crosscheck", "impact", "Whipe", RULES)
    assert unknown.returncode == 2
    assert "did you mean `Wipe`?" in unknown.stderr


def test_the_picture_is_svg_with_all_names(tmp_path: Path) -> None:
    out = tmp_path / "robot.svg"
    assert (
        command_line.run("crosscheck", "show", RULES, "--format", "svg", "--out", out).returncode
        == 0
    )
    texts = [each.text for each in ET.fromstring(out.read_text()).iter() if each.text]
    assert {"Wipe", "contact", "/cmd_vel"} <= {*texts}


def test_a_name_cannot_break_the_picture(tmp_path: Path) -> None:
    robot = put_example(tmp_path)
    skills = robot / "skills.json"
    skills.write_text(skills.read_text().replace('"/cmd_vel"', '"/<script>"'))
    done = command_line.run("crosscheck", "show", robot / "whiteboard.ross")
    assert done.returncode == 1
    assert "Traceback" not in done.stdout + done.stderr


def test_queries_that_take_too_long_are_an_error(
    wide: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("crosscheck.check.LONGEST_S", -1.0)
    found = check_robot(wide)
    assert [each.code for each in found][-1] == "CHK204"
    assert found[-1].severity is Severity.ERROR


@pytest.mark.parametrize(
    ("command", "reason"),
    [
        pytest.param(
            ("crosscheck", "show", "wide.ross", "--format", "svg", "--out"),
            "is there, and crosscheck did not write it",
            id="crosscheck",
        ),
        pytest.param(
            ("rossmarie", "export", "wide.ross", "--out"), "does not end in .json", id="rossmarie"
        ),
        pytest.param(
            ("ezskiros", "export", "skills", "--out"), "does not end in .json", id="ezskiros"
        ),
    ],
)
@pytest.mark.parametrize("stale", ["wide.ross", "skills/motions.py"])
def test_nothing_that_is_read_is_written_over(
    command: tuple[str, ...], reason: str, stale: str, wide: Path
) -> None:
    path = wide.parent / stale
    before = path.read_bytes()
    done = command_line.run(*command, stale, folder=wide.parent)
    assert done.returncode == 2
    assert f"{stale} {reason}" in done.stderr
    assert path.read_bytes() == before


def test_a_robot_is_not_watched_without_ros_or_with_wrong_rules(tmp_path: Path) -> None:
    alone = {
        "PYTHONPATH": os.pathsep.join(each for each in sys.path if "dist-packages" not in each)
    }
    done = subprocess.run(
        [sys.executable, "-m", "crosscheck", "live", RULES],
        capture_output=True, text=True, env={**os.environ, **alone}, check=False,
    )  # fmt: skip
    assert done.returncode == 2
    assert "whiteboard_safety" in done.stderr
    assert "Traceback" not in done.stderr
    wrong = tmp_path / "wrong.ross"
    wrong.write_text("action stop")
    assert command_line.run("crosscheck", "live", wrong).returncode == 1
    named = command_line.run("crosscheck", "live", "--namespace", "a b", RULES)
    assert named.returncode == 2
