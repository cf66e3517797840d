"""The example recordings, and the rules written for them."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest

from dslkit.diagnostics import Collector
from rossmarie.driver import compile_file
from rossmarie.interpreter import Interpreter
from rossmarie.ir import Change, Verdict
from rossmarie.recordings.batches import updates_in
from rossmarie.recordings.opening import open_recording
from rossmarie.recordings.system_model import write_model
from support.parts import A_DRIVE, needs
from support.shared import HUSKY_DRIVE

ROOT = Path(__file__).parents[3]


def record_demo(folder: Path) -> Path:
    """Run examples/demo/record.py; the path of the .mcap file."""
    spec = importlib.util.spec_from_file_location("record", ROOT / "examples/demo/record.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    path = module.write(folder)
    assert isinstance(path, Path)
    return path


@pytest.fixture(scope="module")
def demo(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return record_demo(tmp_path_factory.mktemp("recorded") / "demo")


def activations(rules: Path, recording: Path) -> dict[str, list[tuple[float, Change]]]:
    """The changes of each rule: seconds into the recording, and what happened."""
    machine = compile_file(rules).machine
    monitor = Interpreter(machine)
    collector = Collector()
    found: dict[str, list[tuple[float, Change]]] = defaultdict(list)
    with open_recording(recording) as opened:
        for update in updates_in(machine, opened.batches(machine, collector, {})):
            for event in monitor.update(update.at_ns, update.channels):
                assert isinstance(event, Verdict)
                seconds = (event.at_ns - opened.start_ns) / 1e9
                found[machine.rules[event.rule].name].append((seconds, event.change))
    assert collector.sorted() == ()
    return found


def starts(changes: list[tuple[float, Change]], change: Change) -> list[float]:
    """The times of a rule's changes of one kind, without changes before its inputs arrive."""
    return [round(at, 1) for at, found in changes if found is change and at > 0.5]


# --- the demo --------------------------------------------------------------------------------


def test_demo_is_the_same_on_every_run(tmp_path: Path, demo: Path) -> None:
    again = record_demo(tmp_path / "demo")
    assert record_demo(tmp_path / "demo") == again  # and replaces what was there
    assert again.read_bytes() == demo.read_bytes()


def test_demo_has_the_topics_that_it_promises(demo: Path) -> None:
    with open_recording(demo) as recording:
        assert recording.findings == ()
        assert {topic.name: topic.message_type for topic in recording.topics.values()} == {
            "/fix": "sensor_msgs/NavSatFix",
            "/imu/data": "sensor_msgs/Imu",
            "/odom": "nav_msgs/Odometry",
            "/scan": "sensor_msgs/LaserScan",
        }
        assert 60e9 < recording.end_ns - recording.start_ns < 90e9
        assert "topic /imu/data : sensor_msgs/Imu from imu_link;" in write_model(recording)


def test_demo_shows_what_its_rules_say(demo: Path) -> None:
    found = activations(ROOT / "examples/demo/demo.ross", demo)
    active = {name: starts(changes, Change.ACTIVATED) for name, changes in found.items()}
    assert active == {
        "slow_on_bump": [10.6, 23.4, 30.8],
        "slow_on_slope": [24.7],
        "calm_down": [12.0],
        "keep_distance": [49.3],
        "emergency_stop": [50.3],
        "report_braking": [48.9],
        "position_unknown": [63.5],
    }
    stale = {name for name, changes in found.items() if starts(changes, Change.ACTIVATED_STALE)}
    assert stale == {"slow_on_bump", "slow_on_slope", "calm_down"}
    assert Change.CLEARED not in [change for _, change in found["emergency_stop"]]
    assert "boxed_in" not in found


# --- a real drive ----------------------------------------------------------------------------


@needs(A_DRIVE)
def test_husky_topics() -> None:
    with open_recording(HUSKY_DRIVE) as recording:
        found = [(topic.name, topic.count) for topic in recording.topics.values()]
        assert found == [
            ("/fix", 989),
            ("/husky_velocity_controller/odom", 3952),
            ("/imu/data", 11865),
        ]


@needs(A_DRIVE)
def test_husky_values_are_those_of_the_messages() -> None:
    machine = compile_file(ROOT / "examples/husky/husky.ross").machine
    up, speed = (
        next(index for index, slot in enumerate(machine.slots) if slot.path == path)
        for path in (("linear_acceleration", "y"), ("twist", "twist", "linear", "x"))
    )
    read: dict[int, list[float]] = {up: [], speed: []}
    with open_recording(HUSKY_DRIVE) as recording:
        for update in updates_in(machine, recording.batches(machine, Collector(), {})):
            for values in update.channels.values():
                for slot in read.keys() & values.slots.keys():
                    read[slot].append(values.slots[slot])
    assert np.median(read[up]) == pytest.approx(9.79, abs=0.01)
    assert max(read[speed]) == pytest.approx(1.017, abs=0.001)


@needs(A_DRIVE)
def test_husky_rules_are_active_now_and_then() -> None:
    found = activations(ROOT / "examples/husky/husky.ross", HUSKY_DRIVE)
    counts = {name: len(starts(changes, Change.ACTIVATED)) for name, changes in found.items()}
    assert counts == {
        "slow_when_leaning": 4,
        "slow_on_jolts": 3,
        "slow_on_slopes": 5,
        "limit_speed": 3,
        "turn_gently": 5,
        "stop_without_position": 2,
    }
    assert starts(found["limit_speed"], Change.ACTIVATED_STALE) == [179.9, 194.5]


def test_help_on_the_demo_writes_nothing(tmp_path: Path) -> None:
    command = [sys.executable, str(ROOT / "examples/demo/record.py"), "--help"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert "usage" in done.stdout
    assert list(tmp_path.iterdir()) == []
