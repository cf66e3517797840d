"""The listings of the thesis: what is found in them as printed, and that the corrected ones run."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from rossmarie.driver import check_file, compile_file
from rossmarie.driver.build import build_files
from rossmarie.driver.replay import replay_file
from rossmarie.ir import FieldKind, Machine, Verdict, field_names

THESIS = Path(__file__).parents[2] / "examples" / "thesis"
LISTINGS = ("arm", "mobile_base", "peg_in_hole")

PRINTED = {
    "arm": [
        ("ROSS302", "max_force"),  # N/sec against a force
        ("ROSS202", "torque"),  # a vector against a number
        ("ROSS301", "max_torque"),  # rad/s (Twist.angular) against Nm
    ],
    "mobile_base": [
        ("ROSS203", "reasonabletilt"),  # not in a number
        ("ROSS203", "maxtilt"),
        ("ROSS401", "maxspeedExceeded"),  # never used
        ("ROSS101", "linearSpeed"),
        ("ROSS101", "minSpeed"),
        ("ROSS102", "imuSensorsystem"),  # declared as imuSensorSystem
    ],
    "peg_in_hole": [
        ("ROSS101", "volume_1"),  # declared is volume_2
        ("ROSS101", "distToObject"),  # declared as distToOject
    ],
}


@pytest.mark.parametrize("listing", LISTINGS)
def test_the_faults_of_the_printed_listing_are_found(listing: str) -> None:
    result = check_file(THESIS / f"{listing}_as_printed.ross")
    found = {(one.code, one.primary.span.text) for one in result.diagnostics}
    assert set(PRINTED[listing]) <= found
    assert {code for code, _ in found - set(PRINTED[listing])} <= {"ROSS402"}
    for one in result.diagnostics:
        assert one.help, f"{one.code} says what to write instead"
        assert one.notes or one.labels or one.primary.text


@pytest.mark.parametrize("listing", LISTINGS)
def test_the_corrected_listing_compiles_builds_and_replays(listing: str, tmp_path: Path) -> None:
    rules = THESIS / f"{listing}.ross"
    assert check_file(rules).diagnostics == ()
    machine = compile_file(rules).machine
    written = build_files(rules, "c99", tmp_path / "generated").written
    sources = [path for path in written if path.suffix == ".c"]
    compiler = shutil.which("cc")
    assert compiler is not None
    options = ["-std=c99", "-Wall", "-Wextra", "-Wconversion", "-Wpedantic", "-Werror", "-c"]
    subprocess.run([compiler, *options, *sources], cwd=tmp_path, check=True)
    recording = tmp_path / "drive.csv"
    recording.write_text(drive(machine))
    replay, found = replay_file(rules, recording, topic_map={})
    assert found == ()
    active = {event.rule for event in replay.events if isinstance(event, Verdict)}
    assert active == set(range(len(machine.rules)))


TIMES = np.arange(0.0, 60.0, 0.05)
PITCH = np.radians(np.select([TIMES < 10, TIMES < 25, TIMES < 40], [0.0, 15.0, 25.0], 0.0))
SHAKING = np.where(TIMES < 20, 30.0 * np.sin(2 * np.pi * 2.0 * TIMES), 0.0)

COURSES = {
    "orientation.y": np.sin(PITCH / 2),
    "orientation.w": np.cos(PITCH / 2),
    "orientation.x": np.zeros_like(TIMES),
    "orientation.z": np.zeros_like(TIMES),
    "linearSpeed": np.where(TIMES < 45, 0.3, 0.8),
    "force": SHAKING,
}
"""The signals of some inputs during one minute. All other signals swing slowly through a wide
range.
"""


def drive(machine: Machine) -> str:
    """A minute at 20 Hz as a CSV file."""
    names, _ = field_names(machine)
    columns = {"time": TIMES}
    for index, slot in enumerate(machine.slots):
        topic = machine.channels[machine.inputs[slot.input].channel].topic
        swing = 40.0 * np.sin(2 * np.pi * TIMES / (17.0 + index))
        course = next((COURSES[name] for name in names[index] if name in COURSES), swing)
        values = (course > 0).astype(float) if slot.kind is FieldKind.FLAG else course
        columns[".".join([topic, *map(str, slot.path)])] = values
    for array in machine.arrays:
        topic = machine.channels[machine.inputs[array.input].channel].topic
        columns[".".join([topic, *map(str, array.path), "0"])] = np.zeros_like(TIMES)
    rows = zip(*columns.values(), strict=True)
    lines = [",".join(columns), *(",".join(f"{value:.6g}" for value in row) for row in rows)]
    return "\n".join(lines) + "\n"
