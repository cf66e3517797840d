"""A replay in columns says what a replay message by message says, byte for byte."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rosbags.typesys.store import Typestore

from support.depth import examples
from support.parts import A_DRIVE, needs
from support.recordings import (
    KINDS,
    START_NS,
    Reading,
    battery,
    encoded,
    scan,
    stamped,
    store_of,
    write_kind,
)
from support.replays import message_by_message, reported, without_compiler
from support.shared import HUSKY_DRIVE

ROOT = Path(__file__).parents[3]

RULES = """action stop;
input volts = topic /battery : std_msgs/Float32 in V timeout 0.25 sec;
input scan = topic /scan : sensor_msgs/LaserScan .ranges timeout 0.5 sec;
input frame = topic /scan : sensor_msgs/LaserScan .header.frame_id timeout 2 sec;
input arm = topic /joints : sensor_msgs/JointState .position in rad timeout 0.4 sec;
input mode = topic /mode : std_msgs/String;
input bumped = topic /bumper : std_msgs/Bool timeout 1 sec;
input fix = topic /fix : sensor_msgs/NavSatFix .status timeout 2 sec;
input imu = topic /imu : sensor_msgs/Imu timeout 0.3 sec;
rule low: if volts < 13 V for 0.05 sec or rate(volts) > 100 V/s then { stop; };
rule noisy: if abs(volts - median(volts, 0.3 sec)) > 2 V then { stop; };
rule shaking: if oscillates(volts, 2 times, within 0.5 sec, by 2 V) then { stop; };
rule near: if count(scan < 5 m) > 1 or min(scan) < 0.5 m then { stop; };
rule late: if age(scan) > 0.08 sec for 0.03 sec then { stop; };
rule folded: if any(abs(arm) > 2 rad) or arm[1] - previous(arm[1]) > 1 rad then { stop; };
rule wristy: if hypot(arm[0], arm[1]) > 1 rad then { stop; };
rule busy: if mode == "busy" and not bumped then { stop; } clear when mode == "höher";
rule fixed: if fix.status == 2 then { stop; };
rule tilted: if imu.orientation.pitch() not in [-10, 10] deg then { stop; };
rule twisty: if norm(imu.angular_velocity) > 1 rad/s then { stop; };
rule framed: if frame == "laser" then { stop; };
"""


class Said(NamedTuple):
    """A message: where it is sent, how long after the last one, of which number it is made, and how
    many bytes it lacks, or has too many.
    """

    topic: str
    step_ms: int
    number: float
    more_bytes: int


# --- messages --------------------------------------------------------------------------------


def joints(ros: Typestore, number: float) -> tuple[str, Any]:
    name = "sensor_msgs/msg/JointState"
    positions = np.array([number, -number, 1.0][: int(number) % 4 if math.isfinite(number) else 2])
    names = ["elbow", "wrist", "höher"][: len(positions)]
    nothing = np.empty(0)
    made = ros.types[name](
        header=stamped(ros, 1), name=names, position=positions, velocity=nothing, effort=nothing
    )
    return name, made


def fix(ros: Typestore, number: float) -> tuple[str, Any]:
    name = "sensor_msgs/msg/NavSatFix"
    status = ros.types["sensor_msgs/msg/NavSatStatus"](status=2 if number > 0 else -1, service=1)
    made = ros.types[name](
        header=stamped(ros, 1),
        status=status,
        latitude=number,
        longitude=0.0,
        altitude=math.nan,
        position_covariance=np.zeros(9),
        position_covariance_type=0,
    )
    return name, made


def imu(ros: Typestore, number: float) -> tuple[str, Any]:
    name = "sensor_msgs/msg/Imu"
    vector = ros.types["geometry_msgs/msg/Vector3"]
    made = ros.types[name](
        header=stamped(ros, 1),
        orientation=ros.types["geometry_msgs/msg/Quaternion"](x=0.0, y=number, z=0.0, w=10.0),
        orientation_covariance=np.zeros(9),
        angular_velocity=vector(x=number / 10, y=0.5, z=-0.0),
        angular_velocity_covariance=np.zeros(9),
        linear_acceleration=vector(x=0.0, y=0.0, z=9.81),
        linear_acceleration_covariance=np.zeros(9),
    )
    return name, made


def text(ros: Typestore, number: float) -> tuple[str, Any]:
    name = "std_msgs/msg/String"
    return name, ros.types[name](data={1.0: "höher", 3.0: "idle"}.get(number, "busy"))


def flag(ros: Typestore, number: float) -> tuple[str, Any]:
    name = "std_msgs/msg/Bool"
    return name, ros.types[name](data=number > 10)


def ranges(ros: Typestore, number: float) -> tuple[str, Any]:
    return scan(ros, 1, [number, 4.0, 0.4, math.inf][: 1 if number < 0 else 4])


MAKERS: dict[str, Callable[[Typestore, float], tuple[str, Any]]] = {
    "/battery": battery,
    "/scan": ranges,
    "/joints": joints,
    "/mode": text,
    "/bumper": flag,
    "/fix": fix,
    "/imu": imu,
    "/nobody_reads_this": text,
}


def readings_of(ros: Typestore, said: Sequence[Said]) -> list[Reading]:
    at_ns, found = START_NS, list[Reading]()
    for topic, step_ms, number, more_bytes in said:
        at_ns += step_ms * 1_000_000
        name, message = MAKERS[topic](ros, number)
        content = encoded(ros, name, message)
        content = content + bytes(more_bytes) if more_bytes > 0 else content[: more_bytes or None]
        found.append((topic, at_ns, name, content))
    return found


NUMBERS = (0.0, -0.0, 1.0, 3.0, 12.0, 12.5, 14.0, 17.5, -40.0, 1e30, math.nan, math.inf, -math.inf)
STEPS_MS = (0, 0, 1, 10, 10, 40, 100, 300, 3000, -1, -50, -5000)
messages = st.builds(
    Said,
    st.sampled_from(("/battery", *MAKERS)),
    st.sampled_from(STEPS_MS),
    st.sampled_from(NUMBERS),
    st.sampled_from((0, 0, 0, 0, 0, 0, -1, -3, -9, 1, 4)),
)


# --- comparisons -----------------------------------------------------------------------------


@pytest.fixture(scope="module")
def rules(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("rules") / "all.ross"
    path.write_text(RULES, encoding="utf-8")
    return path


def drive() -> list[Said]:
    """All topics at 50 Hz, with a gap, a clock that is set back, and some damage."""
    said = []
    for row in range(60):
        number = NUMBERS[row % len(NUMBERS)] if row % 3 else float(row % 20)
        for place, topic in enumerate(MAKERS):
            step_ms = {0: 20, 300: 3000, 400: -4000}.get(row * 8 * (place == 0), 20)
            more_bytes = -3 if (row, place) in ((20, 2), (21, 3), (30, 0)) else 0
            said.append(Said(topic, step_ms if place == 0 else 0, number, more_bytes))
    return said


@pytest.mark.parametrize("kind", KINDS)
def test_all_ways_say_the_same(tmp_path: Path, kind: str, rules: Path) -> None:
    recording = write_kind(tmp_path, kind, readings_of(store_of(kind), drive()))
    in_columns = reported(rules, recording)
    assert len(in_columns) > 100
    with message_by_message():
        assert reported(rules, recording) == in_columns
    with without_compiler():
        assert reported(rules, recording) == in_columns


@settings(max_examples=examples(0.5))
@given(st.sampled_from(KINDS), st.lists(messages, min_size=1, max_size=30))
def test_any_messages(rules: Path, kind: str, said: list[Said]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        recording = write_kind(Path(folder), kind, readings_of(store_of(kind), said))
        in_columns = reported(rules, recording)
        with message_by_message():
            assert reported(rules, recording) == in_columns


@settings(max_examples=examples(0.5))
@given(
    st.sampled_from(("bag", "db3", "mcap", "compressed mcap")),
    st.lists(messages, min_size=5, max_size=20),
    st.lists(st.tuples(st.floats(0, 1), st.binary(max_size=9)), min_size=1, max_size=3),
)
def test_damaged_files(
    rules: Path, kind: str, said: list[Said], damage: list[tuple[float, bytes]]
) -> None:
    with tempfile.TemporaryDirectory() as folder:
        recording = write_kind(Path(folder), kind, readings_of(store_of(kind), said))
        content = bytearray(recording.read_bytes())
        for part, other in damage:
            place = int(part * len(content))
            content[place : place + len(other)] = other[: len(content) - place]
        recording.write_bytes(content)
        in_columns = reported(rules, recording)
        with message_by_message():
            assert reported(rules, recording) == in_columns


@pytest.mark.parametrize("part", [0.3, 0.6, 0.9])
@pytest.mark.parametrize("kind", ["bag", "db3", "mcap", "compressed mcap"])
def test_files_that_end_early(tmp_path: Path, kind: str, part: float, rules: Path) -> None:
    recording = write_kind(tmp_path, kind, readings_of(store_of(kind), drive()))
    content = recording.read_bytes()
    recording.write_bytes(content[: int(part * len(content))])
    in_columns = reported(rules, recording)
    with message_by_message():
        assert reported(rules, recording) == in_columns


def test_rows_of_a_table(tmp_path: Path) -> None:
    rules = tmp_path / "table.ross"
    rules.write_text(
        "action stop;\n"
        "input volts = topic /battery : std_msgs/Float32 in V timeout 1 sec;\n"
        "rule low: if volts < 10 V for 2 sec or rate(volts) > 3 V/s then { stop; };\n"
    )
    rows = [
        "time,volts",
        *(f"{second / 2},{9 + second % 7 * (second > 40)}" for second in range(90)),
    ]
    recording = tmp_path / "drive.csv"
    recording.write_text("\n".join([*rows[:50], "9,nan", "30,", *rows[60:], "3,8", "90,8"]))
    in_columns = reported(rules, recording)
    with message_by_message():
        assert reported(rules, recording) == in_columns


@pytest.mark.deep
@needs(A_DRIVE)
def test_a_real_drive() -> None:
    rules = ROOT / "examples/husky/husky.ross"
    in_columns = reported(rules, HUSKY_DRIVE)
    with message_by_message():
        assert reported(rules, HUSKY_DRIVE) == in_columns
