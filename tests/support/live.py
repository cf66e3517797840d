"""What live tests share: processes, a robot that is asked by lines of JSON."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import IO, Any, Protocol, TypeAlias

from rossmarie import ir

LIMIT = 60.0
"""Seconds in which has to come what comes at all; many, as the machine may be busy."""

SOME = 10
"""Commands by which a speed is distinguished from a passing one; planners send 50 in a second."""

Wanted: TypeAlias = ir.Machine | Path
"""What is to be built: the node of a machine, or a package of this repository."""


def until(is_so: Callable[[], bool], what: str) -> None:
    """Wait for something; fail if it does not come."""
    end = time.monotonic() + LIMIT
    while not is_so():
        assert time.monotonic() < end, f"not within {LIMIT} s: {what}"
        time.sleep(0.02)


class Running(Protocol):
    """A running program, as `subprocess.Popen` has it."""

    @property
    def pid(self) -> int: ...
    @property
    def stdin(self) -> IO[str] | None: ...
    @property
    def stdout(self) -> IO[str] | None: ...
    def poll(self) -> int | None: ...
    def wait(self, timeout: float) -> object: ...
    def communicate(self, *, timeout: float) -> object: ...
    def send_signal(self, sig: int) -> object: ...


Start: TypeAlias = Callable[[Sequence[str], Mapping[str, str], IO[bytes]], Running]
"""Starts a command, with variables and a log, in a group of its own."""


def started(command: Sequence[str], variables: Mapping[str, str], log: IO[bytes]) -> Running:
    """A new process of the system, which somebody asks."""
    return _process(command, variables, log, subprocess.PIPE)


def talking(command: Sequence[str], variables: Mapping[str, str], log: IO[bytes]) -> Running:
    """A new process of the system that says everything into its log: a pipe that nobody reads would
    be full some time, and the process wait for ever.
    """
    return _process(command, variables, log, log)


def _process(
    command: Sequence[str], variables: Mapping[str, str], log: IO[bytes], out: IO[bytes] | int
) -> Running:
    return subprocess.Popen(
        command,
        env=variables,
        stdin=subprocess.PIPE,
        stdout=out,
        stderr=log,
        start_new_session=True,
        text=True,
    )


class Process:
    """A program in a group of its own, so that nothing of it survives."""

    def __init__(
        self,
        command: Sequence[str],
        variables: Mapping[str, str],
        log: Path,
        start: Start = started,
    ) -> None:
        log.parent.mkdir(parents=True, exist_ok=True)
        self._log = log.open("a+b")
        self._begin = self._log.seek(0, os.SEEK_END)
        self.running = start(command, variables, self._log)

    def said(self) -> str:
        """What it has written to its log."""
        self._log.seek(self._begin)
        return self._log.read().decode("utf-8", "replace")

    def end(self, how: int = signal.SIGKILL) -> None:
        """End it and what it has started, and wait until it is gone."""
        self.running.poll()
        with suppress(ProcessLookupError):  # its group outlives a program that has ended
            os.killpg(self.running.pid, how)
        self.running.communicate(timeout=LIMIT)
        self._log.close()

    def end_gently(self) -> None:
        """Interrupt it, so that it ends what it has started; end it if it does not."""
        self.running.send_signal(signal.SIGINT)
        try:
            self.running.wait(LIMIT)
        finally:
            self.end()


class Faults:
    """What sanitizers wrote into the logs of a folder."""

    _MARKS = ("ERROR: AddressSanitizer", "ERROR: LeakSanitizer", "runtime error: ")

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._known: set[tuple[Path, int]] = set()

    def new(self) -> list[str]:
        """The lines that were not there the last time."""
        found = {
            (log, number): line
            for log in self._folder.rglob("*.log")
            for number, line in enumerate(log.read_text("utf-8", "replace").splitlines())
            if any(mark in line for mark in self._MARKS)
        }
        lines = [line for place, line in found.items() if place not in self._known]
        self._known.update(found)
        return lines


class Ears(Process):
    """A node that remembers what it hears, and queries to it."""

    def ask(self, **request: object) -> Any:
        assert self.running.stdin is not None
        assert self.running.stdout is not None
        self.running.stdin.write(json.dumps(request) + "\n")
        self.running.stdin.flush()
        answer = self.running.stdout.readline()
        assert answer, self.said()
        return json.loads(answer)

    def set(self, **values: object) -> None:
        self.ask(set=values)

    def heard(self, topic: str) -> list[Any]:
        """What came on a topic since the last `forget`, without the times."""
        return [message for _, message in self.ask(heard=topic)]

    def count(self, topic: str) -> int:
        """How much came on a topic since the last `forget`."""
        return int(self.ask(count=topic))

    def silent(self, topic: str) -> None:
        """Wait until nothing comes on a topic for half a second."""

        def is_silent() -> bool:
            self.ask(forget=topic)
            time.sleep(0.5)
            return self.count(topic) == 0

        until(is_silent, f"{topic} is silent")

    def connected(self, topic: str) -> None:
        """Wait until somebody publishes a topic to it."""
        until(lambda: self.ask(publishers=topic) > 0, f"connected to {topic}")

    def last(self, topic: str) -> Any:
        """What came last; None before the first."""
        found = self.ask(last=topic)
        return found and found[1]


class Robot(Ears):
    """A robot with a planner: `ros1_robot.py` or `ros2_robot.py`."""

    def commands(self, seconds: float) -> list[float]:
        """The speeds on /cmd_vel during the next seconds."""
        self.ask(forget="/cmd_vel")
        time.sleep(seconds)
        return self.speeds()

    def speeds(self) -> list[float]:
        """The speeds on /cmd_vel since the last `forget`."""
        return [float(speed) for speed in self.heard("/cmd_vel")]

    def call(self, service: str, **arguments: object) -> Any:
        return self.ask(call=service, **{"with": arguments})

    def hears_verdicts(self) -> None:
        """Wait until it hears how a rule changes; it stands level then. Verdicts are not kept for
        those who are connected late.
        """
        while not self.heard("/vehicle_safety/verdicts"):
            self.set(pitch=15.0)
            self.passes(0.2)
            self.set(pitch=0.0)
            self.passes(1.0)

    def state(self) -> Any:
        """The last state that was reported; empty before the first."""
        return self.last("/vehicle_safety/state") or {}

    def states(self, action: str) -> list[str]:
        """What has become of the tasks of an action, as far as the node has reported."""
        tasks = self.state().get("tasks", ())
        return [task["state"] for task in tasks if task["action"] == action]

    def diagnoses(self) -> dict[str, str]:
        """The last diagnostics that the node reported: their messages, by name."""
        reported = self.last("/diagnostics")
        return {one["name"]: one["message"] for one in reported["status"]} if reported else {}

    def passes(self, speed: float) -> None:
        """Wait until commands come through at this speed."""
        self.ask(forget="/cmd_vel")
        self._until(lambda: self.last("/cmd_vel") == speed, f"{speed} m/s passes")

    def stays_at(self, speed: float) -> None:
        """The next commands are all so; or 0, as pauses that a busy machine adds are losses of
        inputs.
        """
        self.ask(forget="/cmd_vel")
        self._until(lambda: self.speeds().count(speed) >= SOME, f"{speed} m/s stays")
        assert set(self.speeds()) <= {0.0, speed}, self.diagnoses()

    def _until(self, is_so: Callable[[], bool], what: str) -> None:
        """Wait for something; the failure tells what the node says."""
        try:
            until(is_so, what)
        except AssertionError as error:
            node = f"the node says {self.state()} and {self.diagnoses()}"
            raise AssertionError(f"{error}; {node}, the robot: {self.said()}") from error

    def diagnosed(self, text: str) -> None:
        """Wait until the diagnostics say this."""
        until(lambda: any(text in said for said in self.diagnoses().values()), f"diagnosed: {text}")


class Ros(Protocol):
    """A generation of ROS with the node of the vehicle, built."""

    name: str
    faults: Faults

    @property
    def variables(self) -> dict[str, str]:
        """The environment of its nodes."""
        ...

    @property
    def vehicle(self) -> Path:
        """The program of the node of the vehicle."""
        ...

    def robot(self, namespace: str = "") -> Robot:
        """A new robot, in a namespace such as `/robot1`."""
        ...

    def start(
        self, parameters: Mapping[str, object], *, use_sim_time: bool = False, namespace: str = ""
    ) -> Process:
        """Start the node of the vehicle with these parameters and no others."""
        ...

    def ears(self, *arguments: str, script: str = ...) -> Ears:
        """What hears the topics of the arguments, `TOPIC TYPE ...`; or another script."""
        ...

    def prepare(self, wanted: Sequence[Wanted]) -> list[Path]:
        """Build all of these at once: the programs of nodes, and where those of packages are."""
        ...

    def begin(
        self,
        program: Path,
        parameters: Mapping[str, object],
        *,
        use_sim_time: bool = False,
        namespace: str = "",
        remapped: Sequence[str] = (),
    ) -> Process:
        """Start a node with these parameters and no others, and with names remapped (`/a:=/b`)."""
        ...

    def play(self, recording: Path) -> Process:
        """Play a recording with simulated time."""
        ...

    def launch(
        self, folder: Path, parameters: Mapping[str, object], namespace: str = ""
    ) -> Process:
        """Launch the node with a planner that wants 0.7 m/s; `folder` is for files of the test."""
        ...

    def node_process(self) -> int | None:
        """The process of the node of the vehicle, None if there is none."""
        ...

    def publish(
        self, rate: int, topic: str, ros_type: str, message: str, *, is_kept: bool = False
    ) -> Process:
        """Publish a message at a rate, in a process of its own. A kept one comes late, too."""
        ...

    def ros_type(self, name: str) -> str:
        """How `sensor_msgs/Imu` is called."""
        ...

    def end(self) -> None:
        """End what was started."""
        ...
