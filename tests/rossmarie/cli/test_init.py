"""`rossmarie init` writes files that work at once, and overwrites nothing."""

from __future__ import annotations

import shlex
import subprocess
import time
from pathlib import Path

import pytest

from rossmarie.driver.robots import BuiltInRobot, robots
from support import command_line
from support.first_drives import ARM, BASE, Spoken, drive
from support.parts import A_DRIVE, needs
from support.recordings import KINDS, ROS1, store_of, write_kind, write_ros1
from support.shared import HUSKY_DRIVE


def run(folder: Path, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    return command_line.run("rossmarie", "init", *map(str, arguments), folder=folder)


def next_commands(done: subprocess.CompletedProcess[str]) -> list[list[str]]:
    """The commands that are proposed, without the name of the program."""
    lines = done.stdout.partition("now try:\n")[2].splitlines()
    return [shlex.split(line)[1:] for line in lines]


def follow(done: subprocess.CompletedProcess[str], folder: Path) -> None:
    """Run all commands that are proposed."""
    assert (done.returncode, done.stderr) == (0, "")
    proposed = next_commands(done)
    assert [words[0] for words in proposed] == ["check", "test", "replay"]
    for words in proposed:
        tried = command_line.run("rossmarie", *words, folder=folder)
        assert (tried.returncode, tried.stderr) == (0, ""), (words, tried.stdout)
        assert "warning" not in tried.stdout, tried.stdout


@pytest.mark.parametrize("kind", KINDS)
def test_the_next_commands_succeed(kind: str, tmp_path: Path) -> None:
    path = write_kind(tmp_path, kind, drive(store_of(kind), BASE))
    done = run(tmp_path, path.relative_to(tmp_path), "--out", "my robot")
    assert done.stdout.startswith(
        "wrote my robot/system.ross: the topics and the frames of the recording\n"
        "wrote my robot/robot.ross: 3 inputs, 1 rule, its tests, and 7 proposals as comments\n"
        "now try:\n"
        "  rossmarie check 'my robot/robot.ross'\n"
    )
    follow(done, tmp_path)
    assert (tmp_path / "my robot" / "seen" / "timeline.html").is_file()


@pytest.mark.parametrize("robot", robots(), ids=lambda robot: robot.name)
def test_robots_in_the_box(robot: BuiltInRobot, tmp_path: Path) -> None:
    done = run(tmp_path, robot.recording)
    follow(done, tmp_path)
    assert (tmp_path / "robot" / "robot.ross").is_file()


@needs(A_DRIVE)
def test_a_minute_is_enough_for_a_real_drive(tmp_path: Path) -> None:
    """A recording of six minutes is begun, checked, tested and replayed."""
    begun_s = time.monotonic()
    done = run(tmp_path, HUSKY_DRIVE)
    follow(done, tmp_path)
    assert time.monotonic() - begun_s < 60
    rules = (tmp_path / "robot" / "robot.ross").read_text()
    assert "input odometry = topic /husky_velocity_controller/odom : nav_msgs/Odometry" in rules
    assert "input imu = topic /imu/data : sensor_msgs/Imu timeout 0.1 sec;" in rules


def test_a_topic_without_a_slash_is_mapped(tmp_path: Path) -> None:
    write_ros1(tmp_path / "a drive.bag", drive(ROS1, [BASE[0]._replace(topic="odom"), *BASE[1:]]))
    done = run(tmp_path, "a drive.bag")
    assert next_commands(done)[2] == [
        *("replay", "robot/robot.ross", "a drive.bag", "--topic-map", "/odom=odom"),
        *("--out", "robot/seen"),
    ]
    follow(done, tmp_path)


def test_files_that_are_there_stay(tmp_path: Path) -> None:
    write_ros1(tmp_path / "drive.bag", drive(ROS1, BASE))
    folder = tmp_path / "robot"
    folder.mkdir()
    (folder / "robot.ross").write_text("mine")
    (folder / "notes.txt").write_text("mine")
    done = run(tmp_path, "drive.bag")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        "rossmarie: nothing is written, because these are there: robot/robot.ross; choose another"
        " folder, or replace them with --force\n"
    )
    assert {path.name: path.read_text() for path in folder.iterdir()} == {
        "robot.ross": "mine",
        "notes.txt": "mine",
    }
    follow(run(tmp_path, "drive.bag", "--force"), tmp_path)
    assert (folder / "robot.ross").read_text() != "mine"
    assert (folder / "notes.txt").read_text() == "mine"


def test_a_link_counts_as_a_file(tmp_path: Path) -> None:
    write_ros1(tmp_path / "drive.bag", drive(ROS1, BASE))
    (tmp_path / "robot").mkdir()
    (tmp_path / "robot" / "system.ross").symlink_to("nowhere")
    assert run(tmp_path, "drive.bag").returncode == 2


def test_a_folder_that_cannot_be_written_to(tmp_path: Path) -> None:
    write_ros1(tmp_path / "drive.bag", drive(ROS1, BASE))
    (tmp_path / "robot").write_text("a file")
    done = run(tmp_path, "drive.bag")
    assert (done.returncode, done.stdout) == (2, "")
    assert "cannot write to robot: " in done.stderr


def test_the_folder_of_the_recording_stays_as_it_is(tmp_path: Path) -> None:
    path = write_kind(tmp_path, "mcap directory", drive(store_of("mcap"), BASE))
    before = sorted(each.name for each in path.iterdir())
    done = run(tmp_path, "drive", "--out", "./drive")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "rossmarie: drive is the recording; choose another --out\n"
    assert sorted(each.name for each in path.iterdir()) == before


@pytest.mark.parametrize(
    ("name", "content", "code", "returned"),
    [
        ("nowhere.bag", None, "ROSS610", 2),
        ("notes.txt", "text", "ROSS612", 1),
        ("empty.bag", "", "ROSS613", 1),
        ("text.bag", "text", "ROSS614", 1),
        ("text.mcap", "text", "ROSS614", 1),
        ("volts.csv", "time,volts\n0,1\n1,2\n", "ROSS617", 1),
    ],
)
def test_what_is_no_recording(
    name: str, content: str | None, code: str, returned: int, tmp_path: Path
) -> None:
    if content is not None:
        (tmp_path / name).write_text(content)
    done = run(tmp_path, name)
    assert (done.returncode, done.stderr) == (returned, "")
    assert done.stdout.startswith(f"error[{code}]: ")
    assert not (tmp_path / "robot").exists()


def test_nothing_to_watch(tmp_path: Path) -> None:
    camera = Spoken("/camera", "sensor_msgs/Image", 10, {})
    write_ros1(tmp_path / "drive.bag", drive(ROS1, [camera]))
    done = run(tmp_path, "drive.bag")
    assert (done.returncode, done.stderr) == (1, "")
    assert done.stdout.startswith("error[ROSS625]: cannot write first rules for this recording: ")
    assert "the recording holds `sensor_msgs/Image`" in done.stdout
    assert not (tmp_path / "robot").exists()


@pytest.mark.parametrize("kind", ["bag", "mcap", "db3"])
def test_a_recording_that_is_cut_off(kind: str, tmp_path: Path) -> None:
    """The part that can be read is enough, and the cut is told."""
    path = write_kind(tmp_path, kind, drive(store_of(kind), [*BASE, *ARM], seconds=20))
    path.write_bytes(path.read_bytes()[: path.stat().st_size * 2 // 3])
    done = run(tmp_path, path.name if path.parent == tmp_path else path.relative_to(tmp_path))
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert "warning[ROSS615]: the recording is damaged: " in done.stdout
    checked = command_line.run("rossmarie", *next_commands(done)[0], folder=tmp_path)
    assert (checked.returncode, checked.stdout) == (0, "no errors in 1 file\n")
