"""Wrong calls of the programs are answered in words that say how to call them."""

from __future__ import annotations

import shlex
from pathlib import Path

import pytest

from rossmarie import load
from support.command_line import run

RULES = """action stop;
input on = topic /on : std_msgs/Bool timeout 1 sec
rule it: if on then { stop; };
"""
CALLS = {
    "crosscheck explain EZS401": "EZS401 is a code of ezskiros: run `ezskiros explain EZS401`",
    "crosscheck impact drive.ross Pick": "`crosscheck impact Pick drive.ross`",
    "ezskiros check drive.csv": "drive.csv is neither a Python file",
    "ezskiros check drive.ross": "drive.ross is a rules file: `rossmarie check drive.ross`",
    "ezskiros check d --rules drive.csv": "drive.csv is not a rules file",
    "ezskiros explain Pick": "`ezskiros explain Pick PATHS...`",
    "ezskiros explain ROSS401": "run `rossmarie explain ROSS401`",
    "ezskiros migrate drive.ross": "drive.ross is a rules file",
    "ezskiros run Pick drive.ross": "drive.ross is a rules file",
    "heron run nav --seed x": "`x` is not a whole number",
    "rossmarie check drive.csv": "drive.csv is a recording, not a rules file",
    "rossmarie check drive.ross --system drive.ross": "`drive.ross` is not a system model",
    "rossmarie check drive.ross --toggle 2": "--toggle needs --thorough",
    "rossmarie check skill.py": "`ezskiros check skill.py` checks skills",
    "rossmarie explain CHK102": "run `crosscheck explain CHK102`",
    "rossmarie explain EZS401": "run `ezskiros explain EZS401`",
    "rossmarie replay drive.csv drive.ross": "name the rules file first",
    "rossmarie replay drive.ross drive.ross": "drive.ross is a rules file",
    "rossmarie verify drive.ross --timeout x": "`x` is not a whole number",
}


@pytest.mark.parametrize("call", CALLS)
def test_the_answer_says_how_to_call_it(call: str, tmp_path: Path) -> None:
    (tmp_path / "drive.ross").write_text(RULES)
    (tmp_path / "drive.csv").write_text("time,on\n0.0,0\n")
    (tmp_path / "skill.py").touch()
    (tmp_path / "d").mkdir()
    program, *words = shlex.split(call)
    done = run(program, *words, folder=tmp_path, variables={"COLUMNS": "200"})
    assert done.returncode in (1, 2)
    assert CALLS[call] in done.stdout + done.stderr


def test_a_rule_without_an_action_is_reported(tmp_path: Path) -> None:
    (tmp_path / "drive.ross").write_text(RULES.replace("{ stop; }", "{ }"))
    done = run("rossmarie", "check", "drive.ross", folder=tmp_path)
    assert "warning[ROSS414]: this rule does nothing" in done.stdout
    assert "name the action that it starts" in done.stdout


def test_an_instant_in_seconds_is_refused_with_its_unit(tmp_path: Path) -> None:
    (tmp_path / "drive.ross").write_text(RULES)
    monitor = load(tmp_path / "drive.ross")
    with pytest.raises(TypeError, match=r"number of nanoseconds, such as 500_000_000.*not 0\.5"):
        monitor.update(0.5, {"on": True})  # type: ignore[arg-type]
