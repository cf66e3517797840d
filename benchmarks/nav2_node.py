"""The node of Nav2's collision monitor as a guard on the course, if its package is installed."""

from __future__ import annotations

import importlib
import json
import os
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import course_node
import numpy as np
from course import NS, Command, Contender, Odometry, Scan
from course_node import Lockstep, cpu_ns
from course_scenes import ORIGIN
from nav2_model import CollisionMonitor, points_of
from nav2_settings import Settings

from support import ros2_live

PACKAGE = "nav2_collision_monitor"
ATTEMPTS = 50
START_S = 20.0
POINTS, ZONE = "/collision_monitor/collision_points_marker", "/zone"
"""On these topics, the node shows the points of the last scan, and its first zone with the time."""


def missing() -> str | None:
    """The missing part; None if no part is missing."""
    lacking = course_node.missing()
    if lacking:
        return lacking
    return None if _program() else f"{PACKAGE} is not installed"


def _program() -> Path | None:
    packages: Any = importlib.import_module("ament_index_python.packages")
    try:
        prefix = Path(packages.get_package_prefix(PACKAGE))
    except packages.PackageNotFoundError:
        return None
    return prefix / "lib" / PACKAGE / "collision_monitor"


def version() -> str:
    """The version of the installed package."""
    packages: Any = importlib.import_module("ament_index_python.packages")
    text = Path(packages.get_package_share_directory(PACKAGE), "package.xml").read_text("utf-8")
    return text.partition("<version>")[2].partition("</version>")[0]


class Node:
    """The node with its settings. `contender` drives the runs, one after another.

    Messages on several topics may overtake each other. The node shows the scan and the clock that
    it used. This class compares them with the last messages, and sends the command again if the
    node used older messages. This display costs CPU time. If `is_checked` is false, the node shows
    nothing: its CPU time is the time of its task in real time, and sometimes the node uses the scan
    before the last scan.
    """

    def __init__(self, settings: Settings, folder: Path, *, is_checked: bool = True) -> None:
        self._model = CollisionMonitor(settings)
        self._is_checked = is_checked
        self._domain = ros2_live.Domain()
        shown = {}
        if is_checked:
            shown[POINTS] = course_node.kinds("visualization_msgs").MarkerArray
            shown[ZONE] = course_node.kinds("geometry_msgs").PolygonStamped
        self.lockstep = Lockstep(
            self._domain.number, "/cmd_vel_smoothed", shown, is_paced=not is_checked
        )
        self._last: Scan | None = None
        self._process = self._start(settings, folder)
        self.contender = Contender(settings.name, self._run)

    def _start(self, settings: Settings, folder: Path) -> subprocess.Popen[bytes]:
        folder.mkdir(parents=True, exist_ok=True)
        first = settings.zones[0].name
        given = {
            **settings.parameters(),
            "use_sim_time": True,
            "autostart_node": True,
            "bond_heartbeat_period": 0.0,  # there is no lifecycle manager
            "stop_pub_timeout": 1e6,  # the node answers each command, also while it stops the base
            f"{first}.visualize": self._is_checked,
            f"{first}.polygon_pub_topic": ZONE,
        }
        parameters = folder / "parameters.yaml"
        text = json.dumps({"/**": {"ros__parameters": given}})
        parameters.write_text(text, encoding="utf-8")
        command = [str(_program()), "--ros-args", "--params-file", str(parameters)]
        variables = {**os.environ, "ROS_DOMAIN_ID": str(self._domain.number)}
        with (folder / "node.log").open("wb") as log:
            return subprocess.Popen(command, env=variables, stdout=log, stderr=log)

    def cpu_ns(self) -> int:
        """The CPU time of the node so far (ns)."""
        return cpu_ns(self._process.pid)

    def __call__(
        self,
        scan: Scan | None,
        odometry: Odometry,  # noqa: ARG002 - the node does not use it
        command: Command,
        at_ns: int,
    ) -> Command:
        """The answer of the node."""
        new = scan if scan is not self._last else None
        for attempt in range(ATTEMPTS):
            self.lockstep.tell(at_ns, new, None)
            time.sleep(0.001 * (1 + attempt))
            answer = self.lockstep.ask(command)
            if self._is_by(scan, at_ns):
                self._last = scan
                return answer
        raise TimeoutError(f"the node of {PACKAGE} does not use the last messages")

    def _is_by(self, scan: Scan | None, at_ns: int) -> bool:
        """Say whether the node used this scan and this instant; always true if it shows nothing."""
        if not self._is_checked:
            return True
        heard = self.lockstep.heard
        stamp = heard[ZONE].header.stamp
        shown = [marker.points for marker in heard[POINTS].markers]
        wanted = points_of(scan) if scan and self._model.is_valid(scan, at_ns) else None
        is_now = stamp.sec * NS + stamp.nanosec == self.lockstep.at(at_ns)
        if wanted is None or not shown:
            return is_now and wanted is None and not shown
        x = [point.x for point in shown[0]]
        return is_now and len(x) == len(wanted) and np.allclose(x, wanted[:, 0], atol=1e-4)

    @contextmanager
    def _run(self) -> Iterator[Node]:
        self._last = None
        self.lockstep.begin()
        until = time.monotonic() + START_S
        still = Odometry(0, ORIGIN, Command(0.0, 0.0))
        while True:  # until the node is active and has the clock of this run
            try:
                self(None, still, Command(0.1, 0.0), 0)
                break
            except TimeoutError:
                if time.monotonic() > until or self._process.poll() is not None:
                    raise
        yield self

    def end(self) -> None:
        """End the node."""
        self._process.terminate()
        self._process.wait(10)
        self.lockstep.end()
        self._domain.leave()
