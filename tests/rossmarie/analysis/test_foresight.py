"""Requirements of rules: proved, refuted by a trace that bears it out, or not decided."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from rossmarie.analysis import queries
from rossmarie.analysis.queries import ask_required
from rossmarie.analysis.witness import views
from rossmarie.driver.analyze import analyze_file
from rossmarie.driver.pipeline import compile_file
from rossmarie.driver.report import safety_file
from rossmarie.driver.witness_tests import witness_tests
from rossmarie.ir import TruthValue
from rossmarie.report.safety.kept import kept
from rossmarie.report.safety.page import render_safety_file
from support.rule_skills import FILE

HEAD = f"""
skills "{FILE}";
action slow;
input pose = topic /odom : nav_msgs/Odometry .pose.pose timeout 0.2 sec;
input velocity = topic /odom : nav_msgs/Odometry .twist.twist.linear timeout 0.2 sec;
input button = topic /button : std_msgs/Bool timeout 1 sec;
motion drive {{
    position : pose;
    speed : velocity.x;
    brake : 0.6 m/s^2;
    acceleration : 0.5 m/s^2;
    fastest : 1.5 m/s;
    latency : 0.1 sec;
}}
"""
KEEPS = "keeps drive below 0.3 m/s in SchoolCorridor"
WORST = 1.5 * 0.3 + (1.5**2 - 0.3**2) / 1.2
"""The way in m on which the fastest robot slows down, 0.3 s after its message."""


def found(folder: Path, condition: str, behind: str = "", *, thorough: bool = True) -> set[str]:
    path = folder / "rules.ross"
    path.write_text(
        f"{HEAD}rule r: if {condition} then {{ slow; }} {behind} {KEEPS};\n", encoding="utf-8"
    )
    about = analyze_file(path, thorough=thorough).diagnostics
    codes = ("ROSS721", "ROSS722", "ROSS723", "ROSS729")
    return {each.code for each in about if each.code in codes}


@pytest.mark.parametrize(
    "condition",
    [
        "distance(pose, SchoolCorridor) < stopping(drive, 0.3 m/s)",
        "distance(pose, SchoolCorridor) <= stopping(drive, 0.3 m/s) + 1 cm",
        "distance(pose, SchoolCorridor) < stopping(drive)",
        f"distance(pose, SchoolCorridor) < {WORST + 0.001} m",
        "distance(pose, SchoolCorridor) < stopping(drive, 0.3 m/s) or button",
        "not (distance(pose, SchoolCorridor) >= stopping(drive, 0.3 m/s))",
    ],
)
def test_a_rule_in_time_is_proved(tmp_path: Path, condition: str) -> None:
    assert found(tmp_path, condition, "clear for 1 sec") == {"ROSS722"}
    assert found(tmp_path, condition, "clear for 1 sec", thorough=False) == set()


@pytest.mark.parametrize(
    "condition",
    [
        "distance(pose, SchoolCorridor) < stopping(drive, 0.4 m/s)",
        "distance(pose, SchoolCorridor) < stopping(drive, 0.3 m/s) - 20 cm",
        "distance(pose, SchoolCorridor) < stopping(drive, 0.3 m/s) and button",
        "distance(pose, SchoolCorridor) < stopping(drive, 0.3 m/s) for 0.1 sec",
        f"distance(pose, SchoolCorridor) < {WORST - 0.01} m",
        "pose in SchoolCorridor and abs(velocity.x) > 0.3 m/s",
        "distance(pose, Charger) < stopping(drive, 0.3 m/s)",
    ],
)
def test_a_rule_that_is_late_is_refuted(tmp_path: Path, condition: str) -> None:
    """At the end of the witness it is too late, and the condition is false."""
    assert found(tmp_path, condition, thorough=False) == {"ROSS721"}
    path = tmp_path / "rules.ross"
    (required,) = compile_file(path).requirements
    (late,) = ask_required(required, thorough=False)
    assert late.witness is not None
    last = list(views(required.machine, late.witness, (required.proposition,)))[-1]
    assert last.truth_values[required.proposition] is TruthValue.TRUE
    assert not last.active[0]


@pytest.mark.parametrize(
    ("scope", "exemption"),
    [
        ("while doing Drive", ""),
        ("", "unless doing Push"),
        ("", "unless doing Push then { slow; }"),
        ("", "unless doing Push then if velocity.x > 1 m/s then { slow; }"),
    ],
)
def test_a_rule_that_some_skills_switch_off_is_refuted(
    tmp_path: Path, scope: str, exemption: str
) -> None:
    """Nobody knows that the robot does not move meanwhile."""
    path = tmp_path / "rules.ross"
    path.write_text(
        f"{HEAD}rule r: if distance(pose, SchoolCorridor) < stopping(drive, 0.3 m/s) "
        f"{scope} then {{ slow; }} {exemption} {KEEPS};\n",
        encoding="utf-8",
    )
    codes = {each.code for each in analyze_file(path, thorough=True).diagnostics}
    assert "ROSS721" in codes
    assert "ROSS722" not in codes


def test_a_rule_of_which_nobody_knows_is_an_error(tmp_path: Path) -> None:
    """The solver does not know that all of the school's corridor is in a corridor."""
    condition = "distance(pose, Corridor) < stopping(drive, 0.3 m/s)"
    assert found(tmp_path, condition) == {"ROSS723"}
    content, _ = safety_file(tmp_path / "rules.ross", tool="rossmarie 1", date="2026-01-01")
    (required,) = content.requirements
    assert kept(required, content).outcome == "not decided"


def test_a_requirement_for_which_there_is_no_time_is_an_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(queries, "QUICK_S", 0.0)
    path = tmp_path / "rules.ross"
    found(tmp_path, "distance(pose, SchoolCorridor) < stopping(drive, 0.3 m/s)")
    (required,) = compile_file(path).requirements
    (late,) = ask_required(required, thorough=False)
    assert late.diagnostic.code == "ROSS723"
    assert "the time limit of 0 s" in late.diagnostic.primary.text


def test_an_undecided_requirement_is_no_proved_one(tmp_path: Path) -> None:
    found(tmp_path, "distance(pose, SchoolCorridor) < stopping(drive, 0.3 m/s)")
    content, _ = safety_file(tmp_path / "rules.ross", tool="rossmarie 1", date="2026-01-01")
    (required,) = content.requirements
    assert kept(required, content).outcome == "proved"
    assert kept(required, replace(content, proved=frozenset())).outcome == "not decided"


def test_monitors_do_not_pay_for_requirements(tmp_path: Path) -> None:
    path = tmp_path / "rules.ross"
    rule = "rule r: if distance(pose, SchoolCorridor) < 9 m then { slow; }"
    path.write_text(f"{HEAD}{rule};\n", encoding="utf-8")
    plain = compile_file(path).machine
    path.write_text(f"{HEAD}{rule} {KEEPS};\n", encoding="utf-8")
    asked = compile_file(path)
    assert [each.node for each in asked.machine.signals] == [each.node for each in plain.signals]
    assert len(asked.requirements[0].machine.signals) > len(plain.signals)


def test_the_safety_file_derives_the_way(tmp_path: Path) -> None:
    found(tmp_path, "distance(pose, SchoolCorridor) < 1 m")
    content, _ = safety_file(tmp_path / "rules.ross", tool="rossmarie 1", date="2026-01-01")
    page = render_safety_file(content)
    assert "refuted" in page
    assert f"{WORST:.3g} m" in page
    assert "The brakes engage within 0.3 s of a message" in page


def test_witnesses_are_written_as_tests(tmp_path: Path) -> None:
    """The frame of the places goes without saying in a test."""
    found(tmp_path, "distance(pose, SchoolCorridor) < 1 m")
    rules, tests = tmp_path / "rules.ross", tmp_path / "witnesses.ross"
    written = witness_tests(analyze_file(rules), rules, tests)
    assert written is not None
    assert (written.count, written.left_out) == (1, ())
    assert "frame_id" not in written.text
    assert "expect r inactive at 0 s;" in written.text
