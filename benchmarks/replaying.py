"""Compare a replay of a long recording with rosbags alone and with the former implementation.

Each contender runs in its own process, which reports its CPU time and its peak memory. The
contenders run in turn. The recordings are kept in `build/bench/recordings`.
"""

from __future__ import annotations

import math
import os
import platform
import random
import statistics
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from machine import processor
from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_typestore
from written_page import written_page

FOLDER = Path(__file__).parents[1] / "build" / "bench" / "recordings"
MESSAGES = 300_000
RATE = 100  # Hz
ROUNDS = 3
WANTED = 1.5 / 3.1
"""The target, relative to rosbags alone: 1.5 s on a machine on which rosbags takes 3.1 s."""
IMU = "sensor_msgs/msg/Imu"
START_NS = 1_700_000_000 * 10**9

RULES = """\
action slowDown;
action stop;
input orientation = topic /imu/data : sensor_msgs/Imu .orientation timeout 0.2 sec
input acceleration = topic /imu/data : sensor_msgs/Imu .linear_acceleration timeout 0.2 sec
rule tilted: if orientation.pitch() not in [-10, 10] deg for 1.0 sec then { slowDown; };
rule shaken: if norm(acceleration) > 18 m/s^2 for 0.02 sec then { stop; };
"""

TELL = """\
import re, sys, time
from pathlib import Path

def tell():
    # `resource.getrusage` would include the process before it became Python.
    peak = re.search(r"VmHWM:\\s+(\\d+) kB", Path("/proc/self/status").read_text())
    print(time.process_time(), peak[1], file=sys.stderr)
"""
REPLAY = """
from rossmarie.cli.main import main
sys.argv = ["rossmarie", "replay", *sys.argv[1:3], "--out", sys.argv[3]]
try:
    main()
finally:
    tell()
"""
BEFORE = """
import rossmarie.driver.replay
from rosbags.rosbag1 import Reader
from rossmarie.driver.taking import Beside
from rossmarie.recordings import bag_opening, decoding, readers
from rossmarie.recordings.clock import by_topic
from rossmarie.recordings.intact_bag import IntactBag
from rossmarie.recordings.stored import Stored, packed

class Bag(IntactBag):
    def batches(self, topics):
        ours = {opened.id: connection for opened, connection in self._opened}
        chosen = [opened for opened, connection in self._opened if connection.topic in topics]
        messages = self._bag.messages(chosen)
        return packed(Stored(ours[opened.id], at_ns, part) for opened, at_ns, part in messages)

    def arrivals(self):
        topics = {opened.id: opened.topic for opened, _ in self._opened}
        entries = sorted(
            (entry.chunk_pos, entry.offset, topics[number], entry.time)
            for number, found in self._bag.indexes.items()
            for entry in found
        )
        return by_topic((topic, at_ns) for _, _, topic, at_ns in entries)

readers.IndexedBag, bag_opening.IntactBag = Reader, Bag
decoding.plan_for = lambda *_: None
rossmarie.driver.replay.taking = lambda *asked: Beside(*asked).take
"""
ROSBAGS = """
from rosbags.rosbag1 import Reader
from rosbags.typesys import Stores, get_typestore
store = get_typestore(Stores.ROS1_NOETIC)
with Reader(sys.argv[2]) as reader:
    for connection, _, content in reader.messages():
        store.deserialize_ros1(content, connection.msgtype)
tell()
"""


HEAD = """\
# Cost of a replay

Written by `benchmarks/replaying.py`; do not edit. All figures are CPU times and peak memory of
processes, from one run on one machine ({machine}). The contenders run in
turn; each figure is the median of {rounds} rounds. Absolute figures hold for this machine only;
ratios carry over to other machines.

The input is a ROS 1 bag with {messages:,} messages of type `sensor_msgs/Imu` at {rate} Hz. Two
rules read 7 of the 37 numbers in each message. A replay writes the table, the verdicts and the
timeline. The monitor was built before the measurement.

| | CPU seconds | ratio to rosbags alone | target | peak memory, MB |
|---|---|---|---|---|"""


@dataclass(frozen=True)
class Run:
    """A program, its recording, and the target relative to the CPU time of rosbags alone."""

    program: str
    recording: Path
    wanted: str = ""


def page(folder: Path) -> str:
    """The text of the page; `folder` holds the recordings."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "rules.ross").write_text(RULES, encoding="utf-8")
    long, short, warm = (_recording(folder, MESSAGES // part) for part in (1, 10, 1000))
    runs = {
        "rosbags alone: read and decode all messages": Run(ROSBAGS, long),
        "`rossmarie replay`, former implementation: rosbags reads and decodes each message, and "
        "the interpreter runs beside the monitor": Run(BEFORE + REPLAY, long),
        "**`rossmarie replay`**": Run(REPLAY, long, f"at most {WANTED:.2f}"),
        f"**`rossmarie replay`** of {MESSAGES // 10:,} messages": Run(REPLAY, short),
    }
    _measured(Run(REPLAY, warm), folder)
    found: dict[str, list[tuple[float, float]]] = {name: [] for name in runs}
    for _ in range(ROUNDS):
        for name, run in runs.items():
            found[name].append(_measured(run, folder))
    machine = f"{processor()}; Python {platform.python_version()}"
    head = HEAD.format(machine=machine, rounds=ROUNDS, messages=MESSAGES, rate=RATE)
    return "\n".join([head, *_rows(runs, found)]) + "\n"


def _rows(
    runs: Mapping[str, Run], found: Mapping[str, Sequence[tuple[float, float]]]
) -> Iterator[str]:
    medians = {
        name: [statistics.median(column) for column in zip(*rounds, strict=True)]
        for name, rounds in found.items()
    }
    alone, _ = next(iter(medians.values()))
    for name, (seconds, megabytes) in medians.items():
        cells = (name, f"{seconds:.2f}", f"{seconds / alone:.2f}", runs[name].wanted)
        yield f"| {' | '.join(cells)} | {megabytes:.0f} |"


def _measured(run: Run, folder: Path) -> tuple[float, float]:
    """The CPU seconds and the megabytes of a run."""
    words = [str(folder / "rules.ross"), str(run.recording), str(folder / "report")]
    done = subprocess.run(
        [sys.executable, "-c", TELL + run.program, *words],
        env={**os.environ, "XDG_CACHE_HOME": str(folder / "cache")},
        capture_output=True,
        text=True,
        check=True,
    )
    seconds, kilobytes = done.stderr.splitlines()[-1].split()
    return float(seconds), int(kilobytes) / 1024


def _recording(folder: Path, count: int) -> Path:
    """A bag with `count` messages, written once."""
    path = folder / f"imu{count}.bag"
    if path.is_file():
        return path
    unfinished = folder / "unfinished.bag"
    unfinished.unlink(missing_ok=True)
    store = get_typestore(Stores.ROS1_NOETIC)
    chance = random.Random(1)
    with Writer(unfinished) as writer:
        connection = writer.add_connection("/imu/data", IMU, typestore=store)
        for number in range(count):
            at_ns = START_NS + number * 10**9 // RATE
            message = _message(store.types, number, at_ns, chance)
            writer.write(connection, at_ns, store.serialize_ros1(message, IMU))
    return unfinished.rename(path)


def _message(types: Mapping[str, Any], number: int, at_ns: int, chance: random.Random) -> Any:
    """A message of a rocking vehicle; one rule is active from time to time."""
    stamp = types["builtin_interfaces/msg/Time"](sec=at_ns // 10**9, nanosec=at_ns % 10**9)
    half = 0.12 * math.sin(number / 150) + 0.1 * math.sin(number / 37)  # of the pitch, rad
    vector = types["geometry_msgs/msg/Vector3"]
    return types[IMU](
        header=types["std_msgs/msg/Header"](seq=number, stamp=stamp, frame_id="imu_link"),
        orientation=types["geometry_msgs/msg/Quaternion"](
            x=chance.gauss(0, 0.01), y=math.sin(half), z=0.01, w=math.cos(half)
        ),
        orientation_covariance=np.zeros(9),
        angular_velocity=vector(x=0.1, y=0.2, z=0.3),
        angular_velocity_covariance=np.zeros(9),
        linear_acceleration=vector(
            x=chance.gauss(0, 2), y=chance.gauss(0, 2), z=chance.gauss(9.81, 1.5)
        ),
        linear_acceleration_covariance=np.zeros(9),
    )


def main() -> None:
    """Measure and write the page."""
    written_page(__doc__).write_text(page(FOLDER), encoding="utf-8")


if __name__ == "__main__":
    main()
