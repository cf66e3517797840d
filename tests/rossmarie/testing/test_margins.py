"""The margins of thresholds on recordings."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.driver.coverage import cover_recordings
from rossmarie.testing.margins import ThresholdMargin, ValueRange, moved, thresholds
from support.compiled import machine_of_condition
from support.testing import INPUTS, compiled

SPEEDS = (0.2, 0.9, 1.3, 1.4, 1.4, 1.6, 0.8, 0.1)
CSV = "time,/odom.twist.twist.linear.x,/scan.ranges[0],/scan.ranges[1],fix\n" + "".join(
    f"{index / 4},{value},{1 + value},{2.5 - index / 4},{'1' if index == 2 else ''}\n"
    for index, value in enumerate(SPEEDS)
)


def margins(folder: Path, rule: str) -> list[ThresholdMargin]:
    rules, recording = folder / "rules.ross", folder / "drive.csv"
    rules.write_text(INPUTS + rule, encoding="utf-8")
    recording.write_text(CSV, encoding="utf-8")
    return list(cover_recordings(rules, [recording], topic_map={}).margins)


def rounded(found: ValueRange) -> tuple[float | None, ...]:
    ends = (found.low, found.high)
    return tuple(end if end is None else round(end, 9) for end in ends)


@pytest.mark.parametrize(
    ("rule", "same", "as_often"),
    [
        # Above 1.6 it never becomes active, below 0.1 it is never cleared.
        ("rule r: if speed > 1 m/s then { slow; };", (0.9, 1.3), (0.1, 1.6)),
        ("rule r: if speed > 1 m/s for 0.5 sec then { slow; };", (0.9, 1.3), (0.1, 1.4)),
        ("rule r: if speed > 5 m/s then { slow; };", (1.6, None), (1.6, None)),
        # Where elements are moved together with what they are computed from.
        ("rule r: if any(abs(ranges) > 5 m) then { slow; };", (2.6, None), (2.6, None)),
    ],
)
def test_a_threshold(
    tmp_path: Path,
    rule: str,
    same: tuple[float | None, ...],
    as_often: tuple[float | None, ...],
) -> None:
    found = next(each for each in margins(tmp_path, rule) if each.threshold.constant is not None)
    assert (rounded(found.same), rounded(found.as_often)) == (same, as_often)


def test_a_duration(tmp_path: Path) -> None:
    rule = "rule r: if speed > 1 m/s for 0.5 sec then { slow; };"
    found = next(each for each in margins(tmp_path, rule) if each.threshold.constant is None)
    assert (rounded(found.same), rounded(found.as_often)) == ((0.5, 0.5), (None, 1.0))


def test_a_duration_that_never_passes(tmp_path: Path) -> None:
    rule = "rule r: if speed > 1 m/s for 3 sec then { slow; };"
    found = next(each for each in margins(tmp_path, rule) if each.threshold.constant is None)
    assert rounded(found.same) == (1.0, None)


RULES = """\
const fastest = 1 m/s;
rule a: if speed > fastest and not (speed > 1.5 m/s for 0.3 sec) then { slow; };
rule b: if any(ranges < 2 m) or speed < 0.5 m/s then { stop; } clear for 0.5 sec;
rule c: if age(fix) > 0.6 sec and speed in [0.5, 1.35] m/s then { slow; };
rule d: if count(ranges < 1.5 m) > 1 then { stop; };
"""


def test_what_rests_on_a_threshold_suffices(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = margins(tmp_path, RULES)
    monkeypatch.setattr("rossmarie.driver.coverage.cone_of", lambda *_: None)
    assert margins(tmp_path, RULES) == found


def test_beyond_a_margin_verdicts_change_and_before_it_they_do_not(tmp_path: Path) -> None:
    found = compiled(tmp_path, "rule r: if speed > 1 m/s for 0.5 sec then { slow; };")
    texts = [threshold.text for threshold in thresholds(found.machine)]
    assert texts == ["1 m/s in speed > 1 m/s", "the time of speed > 1 m/s for 0.5 sec"]
    for threshold in thresholds(found.machine):
        assert moved(found.machine, threshold, threshold.value * 2) != found.machine


def test_a_named_constant_is_one_threshold(tmp_path: Path) -> None:
    rules = "const fastest = 1 m/s;\nrule a: if speed > fastest then { slow; };\n"
    rules += "rule b: if abs(speed) > fastest or speed < 0.5 m/s then { stop; };"
    found = compiled(tmp_path, rules)
    assert [each.text for each in thresholds(found.machine)] == [
        "0.5 m/s in speed < 0.5 m/s",
        "fastest",
    ]


def test_the_time_of_what_looks_back_is_reported_as_it_was_written() -> None:
    machine = machine_of_condition("once estop within 2 sec or (estop for 1 sec)")
    assert [each.text for each in thresholds(machine)] == [
        "the time of once estop within 2 sec",
        "the time of estop for 1 sec",
    ]
