"""Comparison of `rossmarie replay` on a recording with a node to which the recording is played."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from rossmarie.driver.replay import replay_file
from rossmarie.ir import Verdict
from support.live import LIMIT, Process, Ros, until

_LONGEST_S = 600.0
Changes = list[tuple[str, int, Any]]
"""Rules, how they changed, and when, in s of the recording's clock."""


def replayed(
    rules: Path,
    recording: Path,
    near: float,
    part: tuple[float, float] = (0.0, 1e9),
    message_folders: Sequence[Path] = (),
) -> Changes:
    """The changes that `rossmarie replay` reports for a part of a recording. Instants may differ by
    `near` s.
    """
    replay, _ = replay_file(rules, recording, topic_map={}, message_folders=message_folders)
    begin, end = part
    return [
        (
            replay.machine.rules[event.rule].name,
            int(event.change),
            pytest.approx(event.at_ns / 1e9, abs=near),
        )
        for event in replay.events
        if isinstance(event, Verdict) and begin <= (event.at_ns - replay.start_ns) / 1e9 <= end
    ]


def says(
    ros: Ros, program: Path, latched: Path, play: Callable[[], Process], count: int
) -> Changes:
    """The changes of rules that a node tells of what is played, `count` or more."""
    heard = verdicts_of(ros, program, latched, play, count)
    return [(reported["rule"], reported["change"], reported["at"]) for reported in heard]


def verdicts_of(
    ros: Ros, program: Path, latched: Path, play: Callable[[], Process], count: int
) -> list[Any]:
    """The verdicts of a node about what is played, `count` or more, as it publishes them."""
    package = program.parent.name
    verdicts = f"/{package}/verdicts"
    with ExitStack() as started:
        # What is played waits for the node, as long as that takes.
        parameters = {"state_file": str(latched), "clock_timeout": LIMIT}
        node = ros.begin(program, parameters, use_sim_time=True)
        started.callback(node.end)
        ears = ros.ears(verdicts, ros.ros_type(f"{package}/Verdict"))
        started.callback(ears.end)
        ears.connected(verdicts)
        player = play()
        started.callback(player.end)
        player.running.wait(_LONGEST_S)
        assert player.running.poll() == 0, player.said()
        until(lambda: ears.count(verdicts) >= count, f"{count} verdicts")
        return ears.heard(verdicts)
