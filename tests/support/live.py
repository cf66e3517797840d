"""What live tests share: processes, a robot that is asked by lines of JSON."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol

from rossmarie import ir


def until(is_so: Callable[[], bool], what: str, seconds: float = 10.0) -> None:
    """Wait for something; fail if it does not come."""
    end = time.monotonic() + seconds
    while not is_so():
        assert time.monotonic() < end, f"not within {seconds} s: {what}"
        time.sleep(0.02)


class Process:
    """A program in a group of its own, so that nothing of it survives."""

    def __init__(self, command: Sequence[str], variables: Mapping[str, str], log: Path) -> None:
        log.parent.mkdir(parents=True, exist_ok=True)
        self._log = log.open("a+b")
        self._begin = self._log.seek(0, os.SEEK_END)
        self.running = subprocess.Popen(
            command,
            env=variables,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._log,
            start_new_session=True,
            text=True,
        )

    def said(self) -> str:
        """What it has written to its standard error."""
        self._log.seek(self._begin)
        return self._log.read().decode("utf-8", "replace")

    def end(self, how: int = signal.SIGKILL) -> None:
        """End it, and wait until it is gone."""
        if self.running.poll() is None:
            os.killpg(self.running.pid, how)
        self.running.communicate(timeout=10)
        self._log.close()

    def end_gently(self) -> None:
        """Interrupt it, so that it ends what it has started; end it if it does not."""
        self.running.send_signal(signal.SIGINT)
        try:
            self.running.wait(20)
        finally:
            self.end()


class Ears(Process):
    """A node that remembers what it hears, and questions to it."""

    def ask(self, **request: object) -> Any:
        assert self.running.stdin is not None
        assert self.running.stdout is not None
        self.running.stdin.write(json.dumps(request) + "\n")
        self.running.stdin.flush()
        return json.loads(self.running.stdout.readline())

    def set(self, **values: object) -> None:
        self.ask(set=values)

    def heard(self, topic: str) -> list[Any]:
        """What came on a topic since the last `forget`, without the times."""
        return [message for _, message in self.ask(heard=topic)]

    def connected(self, topic: str) -> None:
        """Wait until somebody publishes a topic to it."""
        until(lambda: self.ask(publishers=topic) > 0, f"connected to {topic}", 30)

    def last(self, topic: str) -> Any:
        """What came last; None before the first."""
        return next(reversed(self.heard(topic)), None)


class Robot(Ears):
    """A robot with a planner: `ros1_robot.py` or `ros2_robot.py`."""

    def commands(self, seconds: float) -> list[float]:
        """The speeds on /cmd_vel during the next seconds."""
        self.ask(forget="/cmd_vel")
        time.sleep(seconds)
        return [float(speed) for speed in self.heard("/cmd_vel")]

    def call(self, service: str, **arguments: object) -> Any:
        return self.ask(call=service, **{"with": arguments})

    def state(self) -> Any:
        """The last state that was told; None before the first."""
        return self.last("/vehicle_safety/state")

    def states(self, action: str) -> list[str]:
        """What has become of the tasks of an action, as far as the node has told."""
        told = self.state()
        tasks = told["tasks"] if told else ()
        return [task["state"] for task in tasks if task["action"] == action]

    def diagnoses(self) -> dict[str, str]:
        """The last diagnostics that the node told: their messages, by name."""
        told = self.last("/diagnostics")
        return {one["name"]: one["message"] for one in told["status"]} if told else {}

    def passes(self, speed: float, seconds: float = 10.0) -> None:
        """Wait until commands come through at this speed."""
        try:
            until(lambda: self.commands(0.1)[-1:] == [speed], f"{speed} m/s passes", seconds)
        except AssertionError as error:
            node = f"the node says {self.state()} and {self.diagnoses()}"
            raise AssertionError(f"{error}; {node}, the robot: {self.said()}") from error

    def stays_at(self, speed: float, seconds: float = 0.5) -> None:
        """All commands are so during the next seconds; or 0, as pauses that a busy machine adds are
        losses of inputs.
        """
        found = set(self.commands(seconds))
        assert speed in found, self.diagnoses()
        assert found <= {0.0, speed}, self.diagnoses()

    def diagnosed(self, text: str) -> None:
        """Wait until the diagnostics say this."""
        until(lambda: any(text in said for said in self.diagnoses().values()), f"diagnosed: {text}")


class Ros(Protocol):
    """A generation of ROS with the node of the vehicle, built."""

    name: str
    variables: dict[str, str]

    @property
    def vehicle(self) -> Path:
        """The program of the node of the vehicle."""
        ...

    def robot(self) -> Robot:
        """A new robot."""
        ...

    def start(self, parameters: Mapping[str, object], *, use_sim_time: bool = False) -> Process:
        """Start the node of the vehicle with these parameters and no others."""
        ...

    def ears(self, *arguments: str, script: str = ...) -> Ears:
        """What hears the topics of the arguments, `TOPIC TYPE ...`; or another script."""
        ...

    def build(self, machine: ir.Machine) -> Path:
        """Build the node of a machine; its program."""
        ...

    def build_package(self, source: Path) -> Path:
        """Build a package of this repository, called like its folder; where its programs are."""
        ...

    def begin(
        self, program: Path, parameters: Mapping[str, object], *, use_sim_time: bool = False
    ) -> Process:
        """Start a node with these parameters and no others."""
        ...

    def play(self, recording: Path) -> Process:
        """Play a recording with simulated time."""
        ...

    def launch(self, folder: Path, parameters: Mapping[str, object]) -> Process:
        """Launch the node with a planner that wants 0.7 m/s; `folder` is for files of the test."""
        ...

    def node_process(self) -> int | None:
        """The process of the node of the vehicle, None if there is none."""
        ...

    def publish(self, rate: int, topic: str, ros_type: str, message: str) -> Process:
        """Publish a message at a rate, in a process of its own."""
        ...

    def ros_type(self, name: str) -> str:
        """How `sensor_msgs/Imu` is called."""
        ...

    def end(self) -> None:
        """End what was started."""
        ...
