"""A check without the solver says that it asked nothing; a promise without a proof is an error."""

from __future__ import annotations

from pathlib import Path

import pytest

from dslkit.extras import Extras
from rossmarie.driver import analyze
from rossmarie.driver.analyze import analyze_file
from support.rule_skills import FILE

SKILLS = f"""
skills "{FILE}";
action slow;
input pose = topic /odom : nav_msgs/Odometry .pose.pose timeout 0.2 sec;
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.2 sec;
motion drive {{
    position : pose;
    speed : speed;
    brake : 0.6 m/s^2;
    acceleration : 0.5 m/s^2;
    fastest : 1.5 m/s;
    latency : 0.1 sec;
}}
rule near: if distance(pose, SchoolCorridor) < stopping(drive, 0.3 m/s) then {{ slow; }}"""


@pytest.fixture(autouse=True)
def no_solver(monkeypatch: pytest.MonkeyPatch) -> None:
    lacking = Extras("rossmarie", {"solver": ["a_module_that_nobody_has"]})
    monkeypatch.setattr(analyze, "EXTRAS", lacking)


def found(folder: Path, text: str) -> list[tuple[str, str]]:
    path = folder / "rules.ross"
    path.write_text(text, encoding="utf-8")
    return [(each.code, each.severity.name) for each in analyze_file(path).diagnostics]


def test_rules_that_nobody_asked_about_get_a_warning(tmp_path: Path) -> None:
    assert found(tmp_path, f"{SKILLS};\n") == [("ROSS730", "WARNING")]


def test_a_promise_that_nobody_proved_is_an_error(tmp_path: Path) -> None:
    promised = f"{SKILLS}\n    keeps drive below 0.3 m/s in SchoolCorridor;\n"
    assert found(tmp_path, promised) == [("ROSS730", "WARNING"), ("ROSS723", "ERROR")]


def test_a_file_without_rules_needs_no_solver(tmp_path: Path) -> None:
    assert found(tmp_path, "action slow;\n") == []
