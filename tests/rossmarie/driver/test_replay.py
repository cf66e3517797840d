"""Rules run over recordings: what the driver makes of both."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.driver.replay import replay_file
from rossmarie.ir import Change, TaskCommandKind, TimeJump, Verdict
from rossmarie.report.model import Replay
from rossmarie.report.spans import summarize

RULES = """action stop;
input volts = topic /battery : std_msgs/Float32 in V timeout 1 sec;
rule low: if volts < 10 V then { stop; };
"""
COUNTING = """action stop;
input scan = topic /scan : sensor_msgs/LaserScan .ranges timeout 1 sec;
rule boxed_in: if count(scan < 1 m) > 1 then { stop; };
"""


def replayed(folder: Path, rules: str, recording: str) -> Replay:
    (folder / "rules.ross").write_text(rules)
    (folder / "drive.csv").write_text(recording)
    return replay_file(folder / "rules.ross", folder / "drive.csv", topic_map={})[0]


def changes(replay: Replay) -> list[tuple[int, Change]]:
    return [
        (event.at_ns // 10**9, event.change)
        for event in replay.events
        if isinstance(event, Verdict)
    ]


def test_rules_that_count_are_replayed(tmp_path: Path) -> None:
    replay = replayed(tmp_path, COUNTING, "time,scan[0],scan[1]\n0,5,5\n0.5,0.2,0.3\n")
    (plot,) = replay.plots
    assert list(plot.values) == [0.0, 2.0]
    assert len(changes(replay)) == 1


def test_what_actions_would_do_is_reported(tmp_path: Path) -> None:
    """The lights go on at 1 s, and off when the battery is well again."""
    body = "stop { publish /light : std_msgs/Bool { data = true; } at 1 Hz; }\n"
    rules = RULES.replace("stop;\n", body, 1)
    replay = replayed(tmp_path, rules, "time,volts\n0,12\n1,9\n1.5,12\n")
    assert changes(replay) == [(1, Change.ACTIVATED), (1, Change.CLEARED)]
    task_commands = [(each.command.kind, each.after) for each in replay.rehearsed]
    assert task_commands == [(TaskCommandKind.START, 0), (TaskCommandKind.STOP, 1)]


def test_a_clock_that_goes_back_adds_no_silence(tmp_path: Path) -> None:
    """The second run ends after 2 s: nothing is waited for up to the end of the first one."""
    rows = [f"{second},12" for second in (*range(11), 0, 1, 2)]
    replay = replayed(tmp_path, RULES, "\n".join(["time,volts", *rows]))
    assert [type(event) for event in replay.events] == [TimeJump]
    assert (replay.start_ns, replay.end_ns) == (0, 2 * 10**9)
    assert replay.duration_ns == 12 * 10**9
    assert [summary.activations for summary in summarize(replay)] == [0]


@pytest.mark.parametrize(
    ("rows", "span"),
    [("9,,1\n0,12,\n1,12,\n", (0, 1)), ("0,12,\n5,12,\n3,,1\n", (0, 5))],
)
def test_rows_that_no_rule_reads_at_odd_instants(
    tmp_path: Path, rows: str, span: tuple[int, int]
) -> None:
    replay = replayed(tmp_path, RULES, f"time,volts,other\n{rows}")
    assert (replay.start_ns // 10**9, replay.end_ns // 10**9) == span
    assert all(plot.times_s.min() >= 0 for plot in replay.plots)


@pytest.mark.parametrize("compiler", ["", "no-such-compiler"])
def test_plots_hold_numbers_by_which_nothing_changes(
    tmp_path: Path, compiler: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    if compiler:
        monkeypatch.setenv("CC", compiler)
    rules = RULES.replace("volts < 10 V", "volts - 2 V < 8 V")
    rows = [f"{second / 2},{12 + second}" for second in range(5)]
    (plot,) = replayed(tmp_path, rules, "\n".join(["time,volts", *rows])).plots
    assert list(plot.values) == [10.0, 11.0, 12.0, 13.0, 14.0]
