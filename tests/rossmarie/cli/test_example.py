"""`rossmarie example`: robots in the box are listed and copied, and nothing is overwritten."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from rossmarie.driver.robots import robot, robots
from support import command_line

NAMES = [each.name for each in robots()]


def run(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return command_line.run("rossmarie", "example", *arguments, folder=folder)


def test_all_are_listed_in_a_line_each(tmp_path: Path) -> None:
    done = run(tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    assert [line.split()[0] for line in lines] == NAMES
    assert all(len(line) <= 100 and line.split()[1][0].isupper() for line in lines)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", NAMES)
def test_one_is_copied_and_works_there(name: str, tmp_path: Path) -> None:
    done = run(tmp_path, name)
    assert (done.returncode, done.stderr) == (0, "")
    copied = tmp_path / name
    there_are = {path.relative_to(copied) for path in copied.rglob("*") if path.is_file()}
    assert there_are == set(robot(name).files)
    for path in there_are:
        assert (copied / path).read_bytes() == (robot(name).folder / path).read_bytes()
    last = done.stdout.splitlines()[-1].removeprefix("now try: ").split()
    assert last == ["rossmarie", "replay", f"{name}/{name}.ross", f"{name}/{name}.mcap"]
    checked = command_line.run("rossmarie", "check", last[2], folder=tmp_path)
    assert (checked.returncode, checked.stdout) == (0, "no errors in 1 file\n")


def test_a_folder_may_be_named(tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("mine")
    done = run(tmp_path, "Husky", "mine")
    assert done.returncode == 0
    assert "wrote mine/husky.ross\n" in done.stdout
    assert (tmp_path / "mine" / "notes.txt").read_text() == "mine"


def test_nothing_is_written_if_a_file_is_there(tmp_path: Path) -> None:
    folder = tmp_path / "husky"
    folder.mkdir()
    (folder / "husky.ross").write_text("mine")
    (folder / "system.ross").symlink_to("nowhere")
    done = run(tmp_path, "husky")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        "rossmarie: nothing is written, because these are there: "
        "husky/husky.ross, husky/system.ross; "
        "choose another folder, or replace them with --force\n"
    )
    assert sorted(path.name for path in folder.iterdir()) == ["husky.ross", "system.ross"]
    assert (folder / "husky.ross").read_text() == "mine"


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("turtlebot", "did you mean `turtlebot4`?"),
        ("ur5", "did you mean `ur5e`?"),
        ("pepper", f"there are {', '.join(NAMES)}"),
        ("..", f"there are {', '.join(NAMES)}"),
    ],
)
def test_an_unknown_robot(name: str, hint: str, tmp_path: Path) -> None:
    done = run(tmp_path, name)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"rossmarie: there is no robot `{name}`; {hint}\n"


def test_a_folder_that_cannot_be_written_to(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    done = run(tmp_path, "heron", "file")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("rossmarie: cannot write to file: ")
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
