"""A replay takes as much memory for a long recording as for a short one."""

from __future__ import annotations

import random
import subprocess
import sys
from pathlib import Path

import pytest
from rosbags.rosbag2 import StoragePlugin

from support.depth import deep
from support.recordings import START_NS, battery, store_of, write_ros1, write_ros2

RULES = """\
action stop;
input battery = topic /battery : std_msgs/Float32 .data
rule low: if battery < -1 then { stop; };
"""
REPLAY = """\
import re, sys
from pathlib import Path
from rossmarie.driver import sampler
from rossmarie.driver.replay import replay_file
from rossmarie.report import envelope
from rossmarie.report.timeline import render_timeline
rules, recording = map(Path, sys.argv[1:3])
envelope._SAMPLES //= int(sys.argv[3])
sampler._BLOCK //= int(sys.argv[3])
replay, _ = replay_file(rules, recording, topic_map={})
(plot,) = replay.plots
assert plot.values.max() == 5000.0, "the spike is there"
render_timeline(replay)
# Not `resource.getrusage`: it counts what this process was before it became Python.
print(re.search(r"VmHWM:\\s+(\\d+) kB", Path("/proc/self/status").read_text())[1])
"""


def recorded(folder: Path, kind: str, count: int) -> Path:
    """A millisecond between messages, of noise with one spike in the middle."""
    chance = random.Random(5)
    values = [chance.random() for _ in range(count)]
    values[count // 2] = 5000.0
    ros = store_of(kind)
    readings = [
        ("/battery", START_NS + at * 1_000_000, *battery(ros, v)) for at, v in enumerate(values)
    ]
    if kind == "bag":
        return write_ros1(folder / f"drive{count}.bag", readings, chunk_size=100_000)
    return write_ros2(folder / f"drive{count}", readings, StoragePlugin.MCAP)


def peak_kb(folder: Path, kind: str, count: int, smaller: int) -> int:
    """The memory that a replay of so many messages takes, in a process of its own, where a picture
    has fewer samples.
    """
    rules = folder / "low.ross"
    rules.write_text(RULES)
    recording = str(recorded(folder, kind, count))
    command = [sys.executable, "-c", REPLAY, str(rules), recording, str(smaller)]
    return int(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


@pytest.mark.parametrize("kind", ["mcap", *deep(["bag"])])
@pytest.mark.parametrize(
    ("few", "many", "smaller", "most_kb"),
    [(30_000, 130_000, 20, 8_000), *deep([(300_000, 1_000_000, 1, 20_000)])],
)
def test_a_longer_recording_takes_no_more_memory(
    tmp_path: Path, kind: str, few: int, many: int, smaller: int, most_kb: int
) -> None:
    grown = peak_kb(tmp_path, kind, many, smaller) - peak_kb(tmp_path, kind, few, smaller)
    assert grown < most_kb, f"{grown} KB for {many - few} messages"
