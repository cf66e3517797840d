"""A ROS 2 node as a guard on the course, in lockstep.

The course publishes the clock and the new messages, then the command, and waits for the answer
before the next tick. The node sees simulated time, so no message is late on a slow machine. To
measure the CPU time of a node, the course also waits for the real time.
"""

from __future__ import annotations

import importlib
import importlib.util
import math
import time
from collections.abc import Mapping
from functools import partial
from typing import Any

from course import NS, Command, Odometry, Scan

from support import ros2_live

UNHEARD_S = 0.5
APART_NS = 100 * NS
"""The simulated time between two runs. Messages of the run before are then too old."""


def missing() -> str | None:
    """The missing part; None if no part is missing."""
    lacking = ros2_live.missing()
    if lacking:
        return f"ROS 2 is {lacking}"
    return None if importlib.util.find_spec("rclpy") else "rclpy belongs to another Python"


def kinds(package: str) -> Any:
    """The module with the messages of a package."""
    return importlib.import_module(f"{package}.msg")


class Lockstep:
    """The other end of all topics of a node."""

    def __init__(
        self, domain: int, command: str, heard: Mapping[str, Any], *, is_paced: bool
    ) -> None:
        """`command` is the topic of the planner. `heard` has the topics on which the node answers
        each command, with their types; /cmd_vel is always included. `is_paced`: not faster than
        real time.
        """
        self._is_paced = is_paced
        self._began_s = 0.0
        rclpy: Any = importlib.import_module("rclpy")
        executors: Any = importlib.import_module("rclpy.executors")
        sensor: Any = importlib.import_module("rclpy.qos").qos_profile_sensor_data
        self._context = rclpy.Context()
        rclpy.init(context=self._context, domain_id=domain)
        self._node = node = rclpy.create_node("course", context=self._context, enable_rosout=False)
        self._executor = executors.SingleThreadedExecutor(context=self._context)
        self._executor.add_node(node)
        twist, self._scan = kinds("geometry_msgs").Twist(), kinds("sensor_msgs").LaserScan()
        self._clock, self._odometry = kinds("rosgraph_msgs").Clock(), kinds("nav_msgs").Odometry()
        self._twist = twist
        self._tell_time = node.create_publisher(type(self._clock), "/clock", 10).publish
        self._tell_scan = node.create_publisher(type(self._scan), "/scan", sensor).publish
        self._tell_odometry = node.create_publisher(type(self._odometry), "/odom", 10).publish
        self._command = node.create_publisher(type(twist), command, 10).publish
        self._topics = {"/cmd_vel": type(twist), **heard}
        self.heard: dict[str, Any] = {}
        for topic, kind in self._topics.items():
            node.create_subscription(kind, topic, partial(self.heard.__setitem__, topic), 10)
        self._begin_ns = APART_NS

    def begin(self) -> None:
        """Begin another run, later."""
        self._begin_ns += APART_NS

    def at(self, at_ns: int) -> int:
        """The time of the node at an instant of the run (ns)."""
        return self._begin_ns + at_ns

    def tell(self, at_ns: int, scan: Scan | None, odometry: Odometry | None) -> None:
        """Publish the time and the new messages."""
        if at_ns == 0:
            self._began_s = time.monotonic()
        if self._is_paced:
            time.sleep(max(0.0, self._began_s + at_ns / NS - time.monotonic()))
        self._clock.clock.sec, self._clock.clock.nanosec = divmod(self.at(at_ns), NS)
        self._tell_time(self._clock)
        if scan is not None:
            self._tell_scan(self._of_scan(scan))
        if odometry is not None:
            self._tell_odometry(self._of_odometry(odometry))

    def ask(self, command: Command) -> Command:
        """The answer to a command. Raises `TimeoutError` if there is none."""
        self.heard.clear()
        self._twist.linear.x, self._twist.angular.z = command.linear, command.angular
        self._command(self._twist)
        until = time.monotonic() + UNHEARD_S
        while len(self.heard) < len(self._topics):
            if time.monotonic() > until:
                raise TimeoutError("the node does not answer")
            self._executor.spin_once(timeout_sec=UNHEARD_S)
        answer = self.heard["/cmd_vel"]
        return Command(answer.linear.x, answer.angular.z)

    def end(self) -> None:
        """End the node of the course."""
        self._executor.shutdown()
        self._node.destroy_node()
        self._context.try_shutdown()

    def _of_scan(self, scan: Scan) -> Any:
        message = self._scan
        self._stamp(message.header, scan.stamp_ns, "base_link")
        message.angle_min, message.angle_increment = scan.angle_min, scan.angle_increment
        message.angle_max = scan.angle_min + (len(scan.ranges) - 1) * scan.angle_increment
        message.range_min, message.range_max = scan.range_min, scan.range_max
        message.ranges = scan.ranges.tolist()
        return message

    def _of_odometry(self, odometry: Odometry) -> Any:
        message, pose = self._odometry, odometry.pose
        self._stamp(message.header, odometry.stamp_ns, "odom")
        message.child_frame_id = "base_link"
        position, turned = message.pose.pose.position, message.pose.pose.orientation
        position.x, position.y = pose.x, pose.y
        turned.z, turned.w = math.sin(pose.heading / 2), math.cos(pose.heading / 2)
        message.twist.twist.linear.x = odometry.moving.linear
        message.twist.twist.angular.z = odometry.moving.angular
        return message

    def _stamp(self, header: Any, at_ns: int, frame: str) -> None:
        header.stamp.sec, header.stamp.nanosec = divmod(self.at(at_ns), NS)
        header.frame_id = frame


def cpu_ns(process: int) -> int:
    """The CPU time of a process so far (ns)."""
    return time.clock_gettime_ns((~process << 3) | 2)  # the clock of a process, on Linux
