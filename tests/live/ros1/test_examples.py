"""The rules of `examples/` about lists, names and the past: a node says what a replay says."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

from rossmarie.driver import compile_file
from support.example_drives import BEGIN_S, VISION, drive, write
from support.live import Ros, Wanted
from support.live_replay import Changes, replayed, says
from support.recordings import ROS1, write_ros1

NEAR = 0.03
CLEARED = 0


def needs(_generation: str) -> Sequence[Wanted]:
    """One node for all of them, and the messages of a detector."""
    with TemporaryDirectory() as folder:
        return compile_file(write(Path(folder) / "examples.ross")).machine, VISION


pytestmark = [pytest.mark.builds(by=needs)]


def test_a_node_says_what_a_replay_says(ros: Ros, programs: Sequence[Path], tmp_path: Path) -> None:
    recording = write_ros1(tmp_path / "drive.bag", list(drive(ROS1)))
    rules = write(tmp_path / "examples.ross")
    wanted = replayed(rules, recording, NEAR, (BEGIN_S, math.inf))
    activated = {rule for rule, change, _ in wanted if change != CLEARED}
    assert activated == {rule.name for rule in compile_file(rules).machine.rules}
    latched = tmp_path / "latched"
    reported = says(ros, programs[0], latched, lambda: ros.play(recording), len(wanted))
    assert of_each_rule(reported) == of_each_rule(wanted)


def of_each_rule(changes: Changes) -> dict[str, list[tuple[int, Any]]]:
    """The changes of each rule with their times. Rules that change at the same instant may come in
    any order.
    """
    found: dict[str, list[tuple[int, Any]]] = {}
    for rule, change, at in changes:
        found.setdefault(rule, []).append((change, at))
    return found
