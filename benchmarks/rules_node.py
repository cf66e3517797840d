"""A generated ROS 2 node as a guard on the course, in real time."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from course import Command, Contender, Odometry, Scan
from course_node import Lockstep, cpu_ns
from course_rules import Rules

from support import ros2_build, ros2_live

START_S = 20.0


class Node:
    """The node of these rules, built with optimization, as Nav2's packages are."""

    def __init__(self, rules: Rules, folder: Path) -> None:
        machine = rules.machine(folder)
        built = ros2_build.Workspace(folder / "workspace", ["-DCMAKE_BUILD_TYPE=Release"])
        self._ros = ros2_live.Ros2(folder, built)
        (program,) = self._ros.prepare([machine])
        domain = int(self._ros.variables["ROS_DOMAIN_ID"])
        self.lockstep = Lockstep(domain, "/unfil_cmd_vel", {}, is_paced=True)
        self._process = self._ros.begin(program, {}, use_sim_time=True)
        self._last: Scan | None = None
        self.contender = Contender(rules.name, self._run)

    def cpu_ns(self) -> int:
        """The CPU time of the node so far (ns)."""
        return cpu_ns(self._process.running.pid)

    def __call__(
        self, scan: Scan | None, odometry: Odometry, command: Command, at_ns: int
    ) -> Command:
        """The answer of the node."""
        self.lockstep.tell(at_ns, scan if scan is not self._last else None, odometry)
        self._last = scan
        time.sleep(0.001)
        return self.lockstep.ask(command)

    @contextmanager
    def _run(self) -> Iterator[Node]:
        self._last = None
        self.lockstep.begin()
        until = time.monotonic() + START_S
        while True:  # until the node has started
            self.lockstep.tell(0, None, None)
            try:
                self.lockstep.ask(Command(0.1, 0.0))
                break
            except TimeoutError:
                if time.monotonic() > until:
                    raise
        yield self

    def end(self) -> None:
        """End the node."""
        self._process.end()
        self.lockstep.end()
        self._ros.end()
