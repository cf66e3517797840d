"""The node of Nav2's collision monitor as a guard on the course, where its package is installed.

It is a process of its own, and goes in lockstep: the clock and the scan are published, then the
command, and the next tick of the course waits for the answer. Messages on several topics may
overtake each other; what the node shows of the scan and the clock that it went by is compared
with what it was sent, and the command is sent again where that was not the last.
"""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from course import NS, Command, Contender, Odometry, Scan
from nav2_model import CollisionMonitor, points_of
from nav2_settings import Settings

from support import ros2_live

PACKAGE = "nav2_collision_monitor"
APART_NS = 100 * NS
"""Between two runs: so scans of the one before are too old."""

ANSWER_S = 0.5
ATTEMPTS = 50
POINTS, ZONE = "/collision_monitor/collision_points_marker", "/zone"
"""On these it shows the points that it made of the last scan, and its first zone with the time."""

START_S = 20.0


def missing() -> str | None:
    """What is not there of it; None if all is."""
    lacking = ros2_live.missing()
    if lacking:
        return f"ROS 2 is {lacking}"
    if importlib.util.find_spec("rclpy") is None:
        return "rclpy is of another Python"
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
    """The node with its settings. `contender` is for runs, one after the other.

    To show what it goes by costs the node time. It does not have to if `is_checked` is false: then
    its CPU time is that of its task, and now and then it is one scan behind.
    """

    def __init__(self, settings: Settings, folder: Path, *, is_checked: bool = True) -> None:
        self.settings = settings
        self._model = CollisionMonitor(settings)
        self._is_checked = is_checked
        self._rclpy: Any = importlib.import_module("rclpy")
        self._messages = _Messages()
        self._domain = ros2_live.Domain()
        self._context = self._rclpy.Context()
        self._rclpy.init(context=self._context, domain_id=self._domain.number)
        self._node = self._rclpy.create_node("course", context=self._context)
        executors: Any = importlib.import_module("rclpy.executors")
        self._executor = executors.SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._heard: dict[str, Any] = {}
        self._open_topics()
        self._begin_ns = APART_NS
        self._last: Scan | None = None
        self._process = self._start(folder)
        self.contender = Contender(settings.name, self._run)

    def _open_topics(self) -> None:
        quality: Any = importlib.import_module("rclpy.qos")
        made, node = self._messages, self._node
        self._clock = node.create_publisher(made.clock, "/clock", 10)
        self._scan = node.create_publisher(made.scan, "/scan", quality.qos_profile_sensor_data)
        self._command = node.create_publisher(made.twist, "/cmd_vel_smoothed", 10)
        heard = {"/cmd_vel": made.twist}
        if self._is_checked:
            heard |= {POINTS: made.markers, ZONE: made.polygon}
        self._topics = tuple(heard)
        for topic, kind in heard.items():
            node.create_subscription(kind, topic, partial(self._heard.__setitem__, topic), 10)

    def _start(self, folder: Path) -> subprocess.Popen[bytes]:
        folder.mkdir(parents=True, exist_ok=True)
        first = self.settings.zones[0].name
        given = {
            **self.settings.parameters(),
            "use_sim_time": True,
            "autostart_node": True,
            "bond_heartbeat_period": 0.0,  # no manager is there to hear it
            "stop_pub_timeout": 1e6,  # it answers each command, also while it stops the base
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
        """The CPU time that its process has used."""
        return time.clock_gettime_ns((~self._process.pid << 3) | 2)

    def __call__(
        self,
        scan: Scan | None,
        odometry: Odometry,  # noqa: ARG002 - it does not listen to it
        command: Command,
        at_ns: int,
    ) -> Command:
        """The answer of the node."""
        is_new = scan is not self._last
        for attempt in range(ATTEMPTS):
            self._clock.publish(self._messages.of_clock(self._begin_ns + at_ns))
            if scan is not None and is_new:
                self._scan.publish(self._messages.of_scan(scan, self._begin_ns))
            time.sleep(0.001 * (1 + attempt))
            answer = self._ask(command)
            if self._is_by(scan, at_ns):
                self._last = scan
                return answer
        raise TimeoutError(f"the node of {PACKAGE} does not hear what it is sent")

    def _ask(self, command: Command) -> Command:
        self._heard.clear()
        self._command.publish(self._messages.of_command(command))
        until = time.monotonic() + ANSWER_S
        while len(self._heard) < len(self._topics):
            if time.monotonic() > until:
                raise TimeoutError(f"the node of {PACKAGE} does not answer")
            self._executor.spin_once(timeout_sec=ANSWER_S)
        answer = self._heard["/cmd_vel"]
        return Command(answer.linear.x, answer.angular.z)

    def _is_by(self, scan: Scan | None, at_ns: int) -> bool:
        """Say whether it went by this scan and this instant, as far as it is asked to show it."""
        if not self._is_checked:
            return True
        stamp = self._heard[ZONE].header.stamp
        shown = [marker.points for marker in self._heard[POINTS].markers]
        wanted = points_of(scan) if scan and self._model.is_valid(scan, at_ns) else None
        is_now = stamp.sec * NS + stamp.nanosec == self._begin_ns + at_ns
        if wanted is None or not shown:
            return is_now and wanted is None and not shown
        x = [point.x for point in shown[0]]
        return is_now and len(x) == len(wanted) and np.allclose(x, wanted[:, 0], atol=1e-4)

    @contextmanager
    def _run(self) -> Iterator[Node]:
        self._last = None
        odometry: Any = None
        until = time.monotonic() + START_S
        while True:  # until it is active, and has heard the clock of this run
            try:
                self(None, odometry, Command(0.1, 0.0), 0)
                break
            except TimeoutError:
                if time.monotonic() > until or self._process.poll() is not None:
                    raise
        yield self
        self._begin_ns += APART_NS

    def end(self) -> None:
        """No more runs."""
        self._process.terminate()
        self._process.wait(10)
        self._executor.shutdown()
        self._node.destroy_node()
        self._context.try_shutdown()
        self._domain.leave()


class _Messages:
    """Messages of ROS 2; each is made once, and sent again with other numbers."""

    def __init__(self) -> None:
        self.clock: Any = importlib.import_module("rosgraph_msgs.msg").Clock
        self.scan: Any = importlib.import_module("sensor_msgs.msg").LaserScan
        self.twist: Any = importlib.import_module("geometry_msgs.msg").Twist
        self.markers: Any = importlib.import_module("visualization_msgs.msg").MarkerArray
        self.polygon: Any = importlib.import_module("geometry_msgs.msg").PolygonStamped
        self._clock, self._scan, self._twist = self.clock(), self.scan(), self.twist()

    def of_clock(self, at_ns: int) -> Any:
        """The time of the course."""
        self._clock.clock.sec, self._clock.clock.nanosec = divmod(at_ns, NS)
        return self._clock

    def of_scan(self, scan: Scan, begin_ns: int) -> Any:
        """A scan, in the frame of the base."""
        message = self._scan
        message.header.frame_id = "base_link"
        stamp = message.header.stamp
        stamp.sec, stamp.nanosec = divmod(begin_ns + scan.stamp_ns, NS)
        message.angle_min, message.angle_increment = scan.angle_min, scan.angle_increment
        message.angle_max = scan.angle_min + (len(scan.ranges) - 1) * scan.angle_increment
        message.range_min, message.range_max = scan.range_min, scan.range_max
        message.ranges = scan.ranges.tolist()
        return message

    def of_command(self, command: Command) -> Any:
        """A command."""
        self._twist.linear.x, self._twist.angular.z = command.linear, command.angular
        return self._twist
