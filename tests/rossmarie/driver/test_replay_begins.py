"""The beginning of a replay: the messages of the first instant are one update, as in a node."""

from __future__ import annotations

from pathlib import Path

import pytest

from dslkit.diagnostics import Collector
from rossmarie.driver.pipeline import compile_file
from rossmarie.driver.replay import replay_file
from rossmarie.ir import Change, Machine, Verdict
from rossmarie.recordings.batches import begun_together, updates_in
from rossmarie.recordings.opening import open_recording
from support.recordings import KINDS, START_NS, Reading, battery, scan, store_of, write_kind

RULES = """action stop;
input volts = topic /battery : std_msgs/Float32 in V timeout 1 sec;
input scan = topic /scan : sensor_msgs/LaserScan timeout 1 sec;
rule low: if volts < 10 V then { stop; };
rule near: if any(scan.ranges < 0.5 m) then { stop; };
"""
LATER_NS = START_NS + 500_000_000


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    path = tmp_path / "rules.ross"
    path.write_text(RULES, encoding="utf-8")
    return path


def arriving(machine: Machine, recording: Path) -> list[tuple[int, list[int]]]:
    """The instants of updates, and on which channels messages come."""
    with open_recording(recording) as opened:
        batches = opened.batches(machine, Collector(), {})
        found = list(updates_in(machine, begun_together(machine, batches)))
    return [(update.at_ns - START_NS, sorted(update.channels)) for update in found]


def said(kind: str, *heard: tuple[str, int, float]) -> list[Reading]:
    """Messages on `/battery` or `/scan`, with a number."""
    store = store_of(kind)
    return [
        (topic, at_ns, *(battery(store, value) if topic == "/battery" else scan(store, 0, [value])))
        for topic, at_ns, value in heard
    ]


@pytest.mark.parametrize("kind", KINDS)
def test_the_first_messages_of_one_instant_are_seen_together(
    kind: str, rules: Path, tmp_path: Path
) -> None:
    first = ("/battery", START_NS, 12.0), ("/scan", START_NS, 0.2)
    later = ("/battery", LATER_NS, 9.0), ("/scan", LATER_NS, 2.0)
    recording = write_kind(tmp_path, kind, said(kind, *first, *later))
    late_ns = LATER_NS - START_NS
    machine = compile_file(rules).machine
    assert arriving(machine, recording) == [(0, [0, 1]), (late_ns, [0]), (late_ns, [1])]
    replay, _ = replay_file(rules, recording, topic_map={})
    reported = [(each.rule, each.change) for each in replay.events if isinstance(each, Verdict)]
    assert reported == [(1, Change.ACTIVATED), (0, Change.ACTIVATED), (1, Change.CLEARED)]


def test_an_input_that_comes_later_is_stale_before(rules: Path, tmp_path: Path) -> None:
    recording = write_kind(
        tmp_path, "mcap", said("mcap", ("/battery", START_NS, 12.0), ("/scan", LATER_NS, 2.0))
    )
    replay, _ = replay_file(rules, recording, topic_map={})
    reported = [(each.rule, each.change) for each in replay.events if isinstance(each, Verdict)]
    assert reported == [(1, Change.ACTIVATED_STALE), (1, Change.CLEARED)]


def test_a_second_message_of_a_topic_is_an_update_of_its_own(rules: Path, tmp_path: Path) -> None:
    heard = ("/battery", START_NS, 12.0), ("/battery", START_NS, 9.0), ("/scan", START_NS, 2.0)
    recording = write_kind(tmp_path, "mcap", said("mcap", *heard))
    assert arriving(compile_file(rules).machine, recording) == [(0, [0]), (0, [0]), (0, [1])]


def test_a_recording_of_one_instant_is_one_update(rules: Path, tmp_path: Path) -> None:
    heard = ("/battery", START_NS, 12.0), ("/scan", START_NS, 2.0)
    recording = write_kind(tmp_path, "mcap", said("mcap", *heard))
    assert arriving(compile_file(rules).machine, recording) == [(0, [0, 1])]
