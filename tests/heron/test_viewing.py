"""A window where there is a display, and the reason where there is none."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytest.importorskip("mujoco", reason="the simulation needs MuJoCo, which needs Python 3.11")

from heron.experiments import run_placing
from heron.robot.physics import Physics
from heron.scene import ArmParameters, TableParameters, build_placing
from heron.topics import InProcess
from heron.variants import Arm, Table
from heron.viewing import Window


@pytest.mark.parametrize("display", [None, ":4711"])
def test_without_a_display_it_says_so_at_once(display: str | None) -> None:
    environment = {
        name: value
        for name, value in os.environ.items()
        if name not in ("DISPLAY", "WAYLAND_DISPLAY")
    }
    if display:
        environment["DISPLAY"] = display
    program = Path(sys.executable).with_name("heron")
    done = subprocess.run(
        [program, "run", "place", "--view"], env=environment, timeout=60,
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 2
    assert done.stderr.startswith("heron: --view needs a display: ")
    assert "heron demo" in done.stderr
    assert len(done.stderr.splitlines()) == 1


class Handle:
    """A window that is closed after a while."""

    def __init__(self, shown: int) -> None:
        self.left = shown

    def is_running(self) -> bool:
        return self.left > 0

    def sync(self) -> None:
        self.left -= 1

    def close(self) -> None:
        self.left = 0


def test_a_window_goes_with_the_clock_until_it_is_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    handle = Handle(20)
    monkeypatch.setattr("mujoco.viewer.launch_passive", lambda *_: handle)
    physics = Physics(build_placing(TableParameters(), ArmParameters()))
    window = Window()
    (node,) = window.attend(physics, InProcess(), None)
    began = time.monotonic()
    for turn in range(100):
        node.tick(turn * node.period_ns)
    took = time.monotonic() - began
    assert handle.left == 0
    assert took >= 19 * node.period_ns * 1e-9
    assert took < 60 * node.period_ns * 1e-9


@pytest.mark.parametrize(("shown", "windows"), [(3, 2), (0, 1)])
def test_another_scene_gets_another_window_if_somebody_still_looks(
    shown: int, windows: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    handles: list[Handle] = []

    def launch(*_: object) -> Handle:
        handles.append(Handle(shown))
        return handles[-1]

    monkeypatch.setattr("mujoco.viewer.launch_passive", launch)
    physics = Physics(build_placing(TableParameters(), ArmParameters()))
    window = Window()
    nodes = [window.attend(physics, InProcess(), None) for _ in range(2)]
    assert [len(node) for node in nodes] == [1, windows - 1]
    assert [handle.left for handle in handles] == [0, shown][:windows]


def test_an_episode_in_a_window_is_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mujoco.viewer.launch_passive", lambda *_: Handle(3))
    seen = run_placing(Arm.ROSSMARIE, Table.EXPECTED, 0, [Window()])
    assert seen.measures == run_placing(Arm.ROSSMARIE, Table.EXPECTED, 0).measures
