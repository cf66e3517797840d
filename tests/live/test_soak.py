"""A node under load for long: its memory stays as it is, and no verdict is stale.

`--soak 600` makes it ten minutes; `--log-cli-level INFO` shows the figures.
"""

from __future__ import annotations

import logging
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path

import pytest

from rossmarie import ir
from rossmarie.driver.replay import replay_file
from support.compiled import machine_of
from support.live import LIMIT, Ears, Process, Ros, Wanted, until
from support.live_cases import sensors

_LOG = logging.getLogger(__name__)

TOPICS, RATE = 10, 200
SUPPORT = Path(__file__).parents[1] / "support"
VERDICTS = "/sensors_safety/verdicts"
WARM = 2 * TOPICS
"""Verdicts after which it has taken the memory that it needs."""
KIB_OF_GROWTH = 512  # Cyclone DDS begins to use its receive buffers bit by bit: 200 in ten minutes

Change = tuple[str, int]


def needs(generation: str) -> Sequence[Wanted]:
    """The node of the rules, and the package of the talker."""
    return replace(machine_of(sensors(TOPICS)), name="sensors"), SUPPORT / f"{generation}_talker"


@pytest.mark.builds(by=needs)
def test_a_node_runs_for_long(
    ros: Ros, programs: Sequence[Path], tmp_path: Path, pytestconfig: pytest.Config
) -> None:
    seconds = float(pytestconfig.getoption("--soak"))
    program, talkers = programs
    stamped = [f"/sensor_{i}" for i in range(TOPICS)]
    latched = str(tmp_path / "latched")
    with ahead_of_others():
        node = ros.begin(program, {"header_stamps": stamped, "state_file": latched})
        ears = ros.ears(VERDICTS, ros.ros_type("sensors_safety/Verdict"))
    recording = tmp_path / "sent.csv"
    try:
        ears.connected(VERDICTS)
        command = f"exec {talkers / 'talker'} {TOPICS} {RATE} {seconds} >{recording}"
        with ahead_of_others():
            talking = Process(["/bin/sh", "-c", command], ros.variables, tmp_path / "log")
        try:
            until(lambda: ears.count(VERDICTS) >= WARM, "it is at work")
            before_kib = resident_kib(node.running.pid)
            talking.running.wait(seconds + LIMIT)
            assert talking.running.poll() == 0, talking.said()
            growth_kib = resident_kib(node.running.pid) - before_kib
        finally:
            talking.end()
        expected = by_rule(replayed(tmp_path, recording))
        with suppress(AssertionError):  # the comparison tells more
            until(lambda: len(heard(ears)) >= sum(map(len, expected.values())), "all verdicts")
        assert by_rule(heard(ears)) == expected
        _LOG.info("%g s: %d verdicts, %d KiB", seconds, ears.count(VERDICTS), growth_kib)
        if not pytestconfig.getoption("--sanitize"):  # AddressSanitizer keeps what was freed
            assert growth_kib <= KIB_OF_GROWTH
    finally:
        ears.end()
        node.end()


@contextmanager
def ahead_of_others() -> Iterator[None]:
    """Give processes that start within priority over all other work of the machine, if this user
    may do so. A node without processor time for a second misses events.
    """
    usual = os.sched_getscheduler(0), os.sched_getparam(0)
    with suppress(PermissionError):
        os.sched_setscheduler(0, os.SCHED_RR, os.sched_param(1))
    try:
        yield
    finally:
        os.sched_setscheduler(0, *usual)


def heard(ears: Ears) -> list[Change]:
    """The changes that the node has reported, except stale inputs: these come after the talker
    stops.
    """
    changes = [(reported["rule"], reported["change"]) for reported in ears.heard(VERDICTS)]
    return [each for each in changes if each[1] != ir.Change.ACTIVATED_STALE]


def replayed(folder: Path, recording: Path) -> list[Change]:
    """The changes that `rossmarie replay` reports for the sent messages."""
    rules = folder / "sensors.ross"
    rules.write_text(sensors(TOPICS), encoding="utf-8")
    replay, _ = replay_file(rules, recording, topic_map={})
    names = [rule.name for rule in replay.machine.rules]
    verdicts = (event for event in replay.events if isinstance(event, ir.Verdict))
    return [(names[verdict.rule], int(verdict.change)) for verdict in verdicts]


def by_rule(changes: Sequence[Change]) -> dict[str, list[int]]:
    """Each rule's own course: topics may overtake each other on their way to the node."""
    found: dict[str, list[int]] = {f"rule_{i}": [] for i in range(TOPICS)}
    for rule, change in changes:
        found[rule].append(change)
    return found


def resident_kib(process: int) -> int:
    """The memory that a process has."""
    status = Path(f"/proc/{process}/status").read_text(encoding="ascii")
    line = next(line for line in status.splitlines() if line.startswith("VmRSS:"))
    return int(line.split()[1])
