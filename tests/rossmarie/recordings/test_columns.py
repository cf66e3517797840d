"""Slots as columns, from the same pass that feeds a monitor."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from dslkit.diagnostics import Collector
from rossmarie.recordings import Columns, open_recording
from support.recordings import ROS1, START_NS, machine, readings, slot, write_ros1

RULES = machine(
    [("/battery", "std_msgs/Float32"), ("/scan", "sensor_msgs/LaserScan")],
    [("battery", 0), ("scan", 1)],
    [slot(0, "data"), slot(1, "range_max"), slot(1, "not", "recorded")],
)


def test_columns_hold_what_passes_through(tmp_path: Path) -> None:
    kept = Columns(RULES)
    with open_recording(write_ros1(tmp_path / "drive.bag", readings(ROS1))) as recording:
        passed = list(kept.keep(recording.updates(RULES, Collector(), {})))
    assert len(passed) == 20
    battery, range_max, missing = (kept.slot(index) for index in range(3))
    np.testing.assert_array_equal(battery.times_ns, START_NS + np.arange(10) * 100_000_000)
    np.testing.assert_array_equal(battery.values, 12.0 + np.arange(10) / 2)
    np.testing.assert_array_equal(range_max.times_ns, battery.times_ns + 10_000_000)
    np.testing.assert_array_equal(range_max.values, np.full(10, 9.0))
    assert np.isnan(missing.values).all()


def test_nothing_kept_is_an_empty_column() -> None:
    column = Columns(RULES).slot(0)
    assert column.times_ns.shape == column.values.shape == (0,)
