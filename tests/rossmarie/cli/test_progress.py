"""A command shows its step on a terminal only, and the words are gone when the command is over."""

from __future__ import annotations

import os
import pty
import subprocess
import sys
from pathlib import Path

import pytest

from rossmarie.driver.analyze import analyze_file
from support import command_line

MAIN = [sys.executable, "-c", "from rossmarie.cli.main import main; main()"]
RULES = """action stop;
input on = topic /on : std_msgs/Bool timeout 1 sec
rule it: if on then { stop; };
"""
CLEAR_LINE = "\x1b[2K"


@pytest.fixture
def replay(tmp_path: Path) -> list[str]:
    """The words that replay a recording of 2000 messages."""
    rules, drive = tmp_path / "rules.ross", tmp_path / "drive.csv"
    rules.write_text(RULES)
    drive.write_text("time,on\n" + "".join(f"{step / 100},{step % 2}\n" for step in range(2000)))
    return ["replay", str(rules), str(drive)]


def on_terminal(*command: str) -> str:
    """All that a command shows on a terminal beside its output."""
    ours, theirs = pty.openpty()
    environment = {**os.environ, "TERM": "xterm", "COLUMNS": "100"}
    with subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=theirs, env=environment
    ) as running:
        os.close(theirs)
        shown = _all_of(ours)
    os.close(ours)
    assert running.returncode == 0
    return shown


def test_a_terminal_shows_how_far_a_replay_is(replay: list[str]) -> None:
    shown = on_terminal(*MAIN, *replay)
    assert "replaying" in shown
    assert "100%" in shown
    assert shown.rindex(CLEAR_LINE) > shown.rindex("replaying")


def test_elsewhere_nothing_is_shown(replay: list[str]) -> None:
    done = command_line.run("rossmarie", *replay)
    assert done.returncode == 0
    assert "replaying" not in done.stderr + done.stdout
    assert "\x1b" not in done.stderr + done.stdout


STEPS = """
import time
from rossmarie.cli.progress import reported_steps
with reported_steps("reading the rules") as on_step:
    time.sleep({before})
    on_step("which rules are in conflict?")
    time.sleep({behind})
"""


def steps(*, before: float, behind: float) -> list[str]:
    """A command that takes so many seconds for its two steps."""
    return [sys.executable, "-c", STEPS.format(before=before, behind=behind)]


def test_a_terminal_shows_the_step_of_a_command_that_takes_long() -> None:
    shown = on_terminal(*steps(before=2.0, behind=0.3))
    assert shown.index("reading the rules") < shown.index("which rules are in conflict?")
    assert shown.rindex(CLEAR_LINE) > shown.rindex("conflict")


def test_a_command_that_is_done_soon_shows_no_step() -> None:
    assert on_terminal(*steps(before=0.0, behind=0.0)) == ""


def test_a_check_tells_its_queries(tmp_path: Path) -> None:
    reported: list[str] = []
    rules = tmp_path / "rules.ross"
    rules.write_text(RULES)
    analyze_file(rules, on_step=reported.append)
    assert reported[0] == "which rules are in conflict?"
    assert len(reported) > 3


def _all_of(terminal: int) -> str:
    """All that is written to a terminal, until nobody holds its other end."""
    pieces: list[bytes] = []
    try:
        while piece := os.read(terminal, 4096):
            pieces.append(piece)
    except OSError:  # how Linux tells the end
        pass
    return b"".join(pieces).decode()
