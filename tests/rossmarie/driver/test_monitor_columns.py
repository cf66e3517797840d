"""Whole columns: both engines accept, refuse and say the same."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from rossmarie import ColumnError, Monitor
from support.c_compiler import needs_c
from support.engines import ENGINES, load

pytestmark = needs_c

SECOND = 1_000_000_000
NAN = float("nan")
Table = dict[str, np.ndarray]

RULES = """
action slow;
action stop;
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 1 sec
input blocked = topic /bumper : std_msgs/Bool timeout 1 sec
input mode = topic /mode : std_msgs/String
input ranges = topic /scan : sensor_msgs/LaserScan .ranges timeout 1 sec
rule fast: if speed > 1 m/s for 0.05 sec or blocked then { slow; };
rule driven: if mode == "auto" and speed > 0.5 m/s then { slow; };
rule near: if any(ranges < 0.5 m) then { stop; };
"""
ROWS = 300


def random_table(seed: int = 1) -> Table:
    random = np.random.default_rng(seed)
    lacks = random.random(ROWS) < 0.05
    ranges = np.where(random.random((ROWS, 3)) < 0.02, 0.1, 4.0)
    return {
        "speed": np.where(lacks, NAN, random.random(ROWS) * 2),
        "blocked": np.where(random.random(ROWS) < 0.1, NAN, random.random(ROWS) < 0.1),
        "mode": random.choice(["auto", "manual"], ROWS),
        "ranges": np.where(random.random((ROWS, 3)) < 0.02, NAN, ranges),
    }


def random_times(seed: int = 1) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).integers(1, SECOND // 20, ROWS))


def monitors(folder: Path, rules: str = RULES) -> tuple[Monitor, Monitor]:
    native, in_python = (load(rules, engine, folder) for engine in ENGINES)
    return native, in_python


def test_both_say_the_same(tmp_path: Path) -> None:
    times, table = random_times(), random_table()
    native, in_python = (monitor.run(times, table) for monitor in monitors(tmp_path))
    assert native.active.shape == (ROWS, 3)
    assert all(0 < native.active[:, rule].sum() < ROWS for rule in range(3))
    np.testing.assert_array_equal(native.active, in_python.active)
    assert repr(native.events) == repr(in_python.events)


def test_both_say_the_same_in_chunks(tmp_path: Path) -> None:
    times, table = random_times(), random_table()
    whole = load(RULES, "native", tmp_path).run(times, table)
    for monitor in monitors(tmp_path):
        bound = monitor.bind(times, table)
        runs = [
            bound.run(start, min(start + 70, ROWS), active=True) for start in range(0, ROWS, 70)
        ]
        assert repr([event for run in runs for event in run.events]) == repr(whole.events)
        np.testing.assert_array_equal(np.concatenate([run.active for run in runs]), whole.active)
        with pytest.raises(ValueError, match="active=True"):
            _ = bound.run(0, 1).active
        with pytest.raises(IndexError):
            bound.run(0, ROWS + 1)


# --- flags -----------------------------------------------------------------------------------

FLAG = """
action stop;
input clear = topic /clear : std_msgs/Bool timeout 1 sec
rule unsafe: if not clear then { stop; };
"""


@pytest.mark.parametrize("kind", [np.float64, np.float32, np.float16, np.longdouble])
@pytest.mark.parametrize("broken", [NAN, np.inf, -np.inf])
def test_a_flag_that_is_no_number_is_stale(tmp_path: Path, kind: type, broken: float) -> None:
    """Read as true, it would say that the way is clear."""
    column: np.ndarray = np.array([1.0, broken, 0.0, 1.0, 0.5], kind)
    for monitor in monitors(tmp_path, FLAG):
        run = monitor.run(np.arange(5), {"clear": column})
        assert run.active[:, 0].tolist() == [False, True, True, False, False]


@pytest.mark.parametrize("kind", [np.bool_, np.uint8, np.int8, np.int64, np.uint64])
def test_flags_of_any_type(tmp_path: Path, kind: type) -> None:
    column: np.ndarray = np.array([1, 0, 2, 3, 0], kind)
    for monitor in monitors(tmp_path, FLAG):
        run = monitor.run(np.arange(5), {"clear": column})
        assert run.active[:, 0].tolist() == [False, True, False, False, True]


def test_bytes_that_pose_as_booleans_stay_within_the_table(tmp_path: Path) -> None:
    column = np.array([0, 1, 2, 200, 255], np.uint8).view(np.bool_)
    for monitor in monitors(tmp_path, FLAG):
        run = monitor.run(np.arange(5), {"clear": column})
        assert run.active[:, 0].tolist() == [True, False, False, False, False]


# --- strings ---------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["U", object])
def test_strings_are_compared_as_strings(tmp_path: Path, kind: object) -> None:
    rules = """
    action stop;
    input mode = topic /mode : std_msgs/String timeout 1 sec
    rule out: if mode != "auto" and mode != "docked" then { stop; };
    """
    column = np.array(["auto", "docked", "manual", "", "auto "], kind)  # type: ignore[call-overload]
    for monitor in monitors(tmp_path, rules):
        run = monitor.run(np.arange(5), {"mode": column})
        assert run.active[:, 0].tolist() == [False, False, True, True, True]


# --- inputs that only have an age ------------------------------------------------------------

AGES = """
action stop;
input fix = topic /fix : sensor_msgs/NavSatFix timeout 1 sec
input beat = topic /beat : std_msgs/Empty timeout 1 sec
rule blind: if age(fix) > 0.5 sec then { stop; };
rule deaf: if age(beat) > 0.5 sec then { stop; };
"""


def test_what_has_no_column_never_arrives(tmp_path: Path) -> None:
    for monitor in monitors(tmp_path, AGES):
        run = monitor.run(np.arange(4), {"fix": np.array(["any"] * 4)})
        assert run.active.tolist() == [[False, True]] * 4


def test_rows_without_any_column_are_instants(tmp_path: Path) -> None:
    for monitor in monitors(tmp_path, AGES):
        assert monitor.run(np.arange(4), {}).active.tolist() == [[True, True]] * 4


def test_an_only_topic_without_a_column_never_arrives(tmp_path: Path) -> None:
    rules = AGES.replace("input beat", "//").replace("rule deaf", "//")
    for monitor in monitors(tmp_path, rules):
        assert monitor.run(np.arange(2), {}).active.tolist() == [[True], [True]]
        arrived = monitor.run(np.arange(2, 4), {"fix": np.zeros(2)})
        assert arrived.active.tolist() == [[False], [False]]


# --- what does not fit -----------------------------------------------------------------------

TIMES = np.arange(4) * SECOND
GOOD: Table = {
    "speed": np.zeros(4),
    "blocked": np.zeros(4, np.bool_),
    "mode": np.array(["auto"] * 4),
    "ranges": np.full((4, 2), 3.0),
}


def changed(**columns: np.ndarray) -> Callable[[], tuple[np.ndarray, Table]]:
    return lambda: (TIMES, {**GOOD, **columns})


def timed(times: np.ndarray) -> Callable[[], tuple[np.ndarray, Table]]:
    return lambda: (times, GOOD)


def without(name: str) -> Callable[[], tuple[np.ndarray, Table]]:
    return lambda: (TIMES, {key: value for key, value in GOOD.items() if key != name})


@pytest.mark.parametrize(
    ("given", "complaint"),
    [
        (without("speed"), "no columns for speed"),
        (without("mode"), "no columns for mode"),
        (without("ranges"), "no columns for ranges"),
        (changed(sped=np.zeros(4)), "no rule reads the column sped"),
        (changed(**{"speed.x": np.zeros(4)}), "2 columns for speed"),
        (changed(speed=np.zeros(3)), r"shape \(3,\)"),
        (changed(speed=np.zeros(5)), r"shape \(5,\)"),
        (changed(speed=np.zeros((4, 1))), "one scalar a row"),
        (changed(speed=np.zeros(4, complex)), "holds complex128, not numbers"),
        (changed(speed=np.array([1.0, None, 2.0, 3.0], object)), "holds object, not numbers"),
        (changed(speed=np.array(["1"] * 4)), "not numbers"),
        (changed(speed=TIMES.astype("M8[ns]")), "not numbers"),
        (changed(blocked=np.zeros(4, complex)), "holds complex128, not flags"),
        (changed(blocked=np.array(["yes"] * 4)), "not flags"),
        (changed(mode=np.zeros(4)), "holds float64, not only strings"),
        (changed(mode=np.array(["auto", 0, None, "auto"], object)), "not only strings"),
        (changed(mode=np.array([b"auto"] * 4)), "not only strings"),
        (changed(ranges=np.zeros(4)), "column ranges is an array"),
        (changed(ranges=np.zeros((4, 2), complex)), "column ranges is an array"),
        (changed(ranges=np.zeros((4, 2, 2))), "column ranges is an array"),
        (timed(TIMES.astype(np.float64)), "int64"),
        (timed(TIMES.astype(np.int32)), "int64"),
        (timed(TIMES.reshape(4, 1)), "int64"),
        (timed(np.array([0, 1, 2**62, 3])), "row 2 is out of range"),
        (timed(np.array([-(2**61), 1, 2, 3])), "row 0 is out of range"),
    ],
)
@pytest.mark.parametrize("engine", ENGINES)
def test_both_refuse_the_same(
    tmp_path: Path, engine: str, given: Callable[[], tuple[np.ndarray, Table]], complaint: str
) -> None:
    times, table = given()
    monitor = load(RULES, engine, tmp_path)
    for take in (monitor.run, monitor.bind):
        with pytest.raises(ColumnError, match=complaint):
            take(times, table)
    assert monitor.next_wake() is None, "nothing was taken in"


def test_both_accept_what_can_be_converted(tmp_path: Path) -> None:
    table = {
        "speed": np.zeros(8, ">f4")[::2],
        "blocked": np.zeros((4, 2), np.int16)[:, 1],
        "mode": np.array(["auto"] * 4, object),
        "ranges": np.full((2, 4), 3, np.uint8).T,
    }
    for monitor in monitors(tmp_path):
        assert not monitor.run(TIMES, table).active.any()
        assert not monitor.run(TIMES[:0], {name: table[name][:0] for name in table}).events
