"""A window where there is a display, and the reason where there is none."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from support.parts import DISPLAY, MUJOCO, needs, require

require(MUJOCO)

from heron.experiments import EXPERIMENTS, run_placing
from heron.robot.physics import Physics
from heron.scene import ArmParameters, TableParameters, build_placing
from heron.topics import InProcess
from heron.variants import ExperimentArm, Table
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


@pytest.fixture
def display() -> Iterator[str]:
    """A display that nobody sees."""
    reading, writing = os.pipe()
    arguments = ["Xvfb", "-displayfd", str(writing), "-screen", "0", "640x480x24"]
    running = subprocess.Popen(arguments, pass_fds=[writing], stderr=subprocess.DEVNULL)
    os.close(writing)
    try:
        with os.fdopen(reading) as reported:
            yield f":{reported.readline().strip()}"
    finally:
        running.terminate()
        running.wait()


@pytest.mark.deep
@needs(DISPLAY)
def test_a_window_is_opened_and_closed(display: str) -> None:
    program = Path(sys.executable).with_name("heron")
    done = subprocess.run(
        [program, "run", "place", "--view"], env={**os.environ, "DISPLAY": display}, timeout=120,
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    assert "completed" in done.stdout


class Handle:
    """A window that is closed after a while."""

    def __init__(self, shown: int) -> None:
        self.left = shown
        self.cam = SimpleNamespace(lookat=[0.0, 0.0, 0.0])
        self.lock = contextlib.nullcontext

    def is_running(self) -> bool:
        return self.left > 0

    def sync(self) -> None:
        self.left -= 1

    def close(self) -> None:
        self.left = 0


def test_a_window_goes_with_the_clock_until_it_is_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    handle = Handle(20)
    monkeypatch.setattr("mujoco.viewer.launch_passive", lambda *_, **__: handle)
    physics = Physics(build_placing(TableParameters(), ArmParameters()))
    window = Window(EXPERIMENTS["place"].cameras * 2)
    (node,) = window.attend(physics, InProcess(), None)
    began = time.monotonic()
    for turn in range(20):
        node.tick(turn * node.period_ns)
    assert handle.left == 0
    assert time.monotonic() - began >= 19 * node.period_ns * 1e-9
    node.tick(10**18)  # a wait of 30 years, unless the window is gone


@pytest.mark.parametrize(("shown", "windows"), [(3, 2), (0, 1)])
def test_another_scene_gets_another_window_if_somebody_still_looks(
    shown: int, windows: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    handles: list[Handle] = []

    def launch(*_: object, **__: object) -> Handle:
        handles.append(Handle(shown))
        return handles[-1]

    monkeypatch.setattr("mujoco.viewer.launch_passive", launch)
    physics = Physics(build_placing(TableParameters(), ArmParameters()))
    window = Window(EXPERIMENTS["place"].cameras * 2)
    nodes = [window.attend(physics, InProcess(), None) for _ in range(2)]
    assert [len(node) for node in nodes] == [1, windows - 1]
    assert [handle.left for handle in handles] == [0, shown][:windows]


def test_an_episode_in_a_window_is_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mujoco.viewer.launch_passive", lambda *_, **__: Handle(3))
    seen = run_placing(
        ExperimentArm.ROSSMARIE, Table.EXPECTED, 0, [Window(EXPERIMENTS["place"].cameras * 2)]
    )
    assert seen.measures == run_placing(ExperimentArm.ROSSMARIE, Table.EXPECTED, 0).measures
