"""The recorded numbers that a reader can add to a timeline."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from rossmarie.driver import recorded
from rossmarie.driver.replay import replay_file
from rossmarie.report.model import Replay

RULES = """action stop;
input drive = topic /odom : nav_msgs/Odometry .twist.twist timeout 1 sec;
input volts = topic /battery : sensor_msgs/BatteryState timeout 1 sec;
rule fast: if drive.linear.x > 1 m/s then { stop; };
rule low: if volts.voltage < 10 V then { stop; };
"""
HEAD = "time,drive.linear.x,drive.angular.z,volts.voltage,volts.present,volts.header.stamp"


def replayed(folder: Path, *rows: str, with_recorded: bool = True) -> Replay:
    (folder / "rules.ross").write_text(RULES)
    (folder / "drive.csv").write_text("\n".join((HEAD, *rows)))
    rules, drive = folder / "rules.ross", folder / "drive.csv"
    return replay_file(rules, drive, topic_map={}, with_recorded=with_recorded)[0]


def test_each_recorded_number_can_be_added(tmp_path: Path) -> None:
    replay = replayed(tmp_path, "5,0.5,0.1,12,1,5", "6,0.6,,,,", "7,0.7,0.3,11,0,7")
    found = {plot.text: plot for plot in replay.recorded}
    assert list(found) == [
        "/odom twist.twist.linear.x",
        "/odom twist.twist.angular.z",
        "/battery voltage",
        "/battery present",
    ]
    speed = found["/odom twist.twist.linear.x"]
    assert (speed.unit, list(speed.times_s), list(speed.values)) == (
        "m/s",
        [0.0, 1.0, 2.0],
        [0.5, 0.6, 0.7],
    )
    turning = found["/odom twist.twist.angular.z"]
    assert np.array_equal(turning.values, [0.1, np.nan, 0.3], equal_nan=True)
    assert list(found["/battery voltage"].times_s) == [0.0, 2.0]
    assert list(found["/battery present"].values) == [1.0, 0.0]


def test_they_are_read_for_a_timeline_only(tmp_path: Path) -> None:
    assert replayed(tmp_path, "5,0.5,0.1,12,1,5", with_recorded=False).recorded == ()


def test_where_the_clock_goes_back_the_axis_goes_on(tmp_path: Path) -> None:
    replay = replayed(tmp_path, "5,0.5,,,,", "9,0.6,,,,", "6,0.7,,,,")
    assert list(replay.recorded[0].times_s) == [0.0, 4.0, 4.0]


def test_there_are_not_too_many(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recorded, "MOST_SIGNALS", 1)
    assert len(replayed(tmp_path, "5,0.5,0.1,12,1,5").recorded) == 1
