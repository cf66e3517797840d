"""The progress bar of a replay: on a terminal only, and gone when the replay is over."""

from __future__ import annotations

import os
import pty
import subprocess
import sys
from pathlib import Path

import pytest

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


def test_a_terminal_shows_how_far_a_replay_is(replay: list[str]) -> None:
    ours, theirs = pty.openpty()
    environment = {**os.environ, "TERM": "xterm", "COLUMNS": "100"}
    with subprocess.Popen(
        [*MAIN, *replay], stdout=subprocess.DEVNULL, stderr=theirs, env=environment
    ) as running:
        os.close(theirs)
        shown = _all_of(ours)
    os.close(ours)
    assert running.returncode == 0
    assert "replaying" in shown
    assert "100%" in shown
    assert shown.rindex(CLEAR_LINE) > shown.rindex("replaying")


def test_elsewhere_nothing_is_shown(replay: list[str]) -> None:
    done = command_line.run("rossmarie", *replay)
    assert done.returncode == 0
    assert "replaying" not in done.stderr + done.stdout
    assert "\x1b" not in done.stderr + done.stdout


def _all_of(terminal: int) -> str:
    """All that is written to a terminal, until nobody holds its other end."""
    pieces: list[bytes] = []
    try:
        while piece := os.read(terminal, 4096):
            pieces.append(piece)
    except OSError:  # how Linux tells the end
        pass
    return b"".join(pieces).decode()
