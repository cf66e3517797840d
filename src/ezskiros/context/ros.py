"""The context message over ROS 1 or ROS 2, whichever this Python has; if it has both, the sourced
one. ROS packages are only imported on first use.
"""

from __future__ import annotations

import contextlib
import importlib
import os
import threading
import time
from collections.abc import Callable
from types import ModuleType
from typing import Any

from ezskiros.context.snapshot import RunningSkill, SkillAhead, SkillArgument, Snapshot
from ezskiros.context.voice import Publish
from ezskiros.export.write import TOPIC

_NODE = "ezskiros_context"
_NAME = TOPIC.removeprefix("/")
"""The topic name in the namespace of the node, because each robot has its own topic."""


class NoRosError(Exception):
    """The context cannot be published. The text gives the reason."""


def connect(clock: Callable[[], float] = time.monotonic) -> Publish:
    """The function that publishes snapshots, with times of `clock`. Raises `NoRosError`."""
    try:
        messages = importlib.import_module("skill_context_msgs.msg")
    except ImportError:
        raise NoRosError("the package `skill_context_msgs` is not installed") from None
    name, library = ros_library()
    connected = _ros1 if name == "rospy" else _ros2
    publish, now = connected(library, messages)
    return Messages(messages, publish, now, clock).publish


def ros_library() -> tuple[str, ModuleType]:
    """The name and the module of the ROS library of this process, `rospy` or `rclpy`. Raises
    `NoRosError` if there is none.
    """
    for name in ros_libraries():
        with contextlib.suppress(ImportError):
            return name, importlib.import_module(name)
    raise NoRosError("neither `rospy` nor `rclpy` is installed")


def ros_libraries() -> tuple[str, str]:
    """The names of both libraries. The library of the sourced ROS comes first."""
    is_ros2 = os.environ.get("ROS_VERSION") == "2"
    return ("rclpy", "rospy") if is_ros2 else ("rospy", "rclpy")


def _ros1(rospy: ModuleType, messages: Any) -> tuple[Callable[[Any], object], Callable[[], Any]]:
    if not importlib.import_module("rosgraph").is_master_online():
        raise NoRosError("no ROS master answers")
    if not rospy.core.is_initialized():
        rospy.init_node(_NODE, anonymous=True, disable_signals=True)
    publisher = rospy.Publisher(_NAME, messages.SkillContext, queue_size=1)
    return publisher.publish, rospy.Time.now


def _ros2(rclpy: ModuleType, messages: Any) -> tuple[Callable[[Any], object], Callable[[], Any]]:
    node = ros2_node(rclpy, _NODE)
    publisher = node.create_publisher(messages.SkillContext, _NAME, 1)
    clock = node.get_clock()
    return publisher.publish, lambda: clock.now().to_msg()


def ros2_node(rclpy: ModuleType, name: str) -> Any:
    """A ROS 2 node, in the namespace `ROS_NAMESPACE`, as in ROS 1."""
    _begin_ros2(rclpy)
    return rclpy.create_node(name, namespace=os.environ.get("ROS_NAMESPACE", ""))


def ros2_spun(
    node: Any, seconds: float, look: Callable[[], object] = lambda: None
) -> Callable[[], object]:
    """Spin a ROS 2 node in a thread, which calls `look` at least once in some seconds. Returns the
    function that ends both.
    """
    executor = importlib.import_module("rclpy.executors").SingleThreadedExecutor()
    executor.add_node(node)
    has_ended = threading.Event()

    def spin() -> None:
        while not has_ended.is_set():
            executor.spin_once(timeout_sec=seconds)
            look()

    thread = threading.Thread(target=spin, daemon=True)
    thread.start()

    def end() -> None:
        """Wait for the thread before the node is destroyed: otherwise rclpy aborts the process."""
        has_ended.set()
        thread.join()
        executor.shutdown()
        node.destroy_node()

    return end


def _begin_ros2(rclpy: ModuleType) -> None:
    """Initialize ROS 2 in this process, unless this has been done. Signal handlers stay unchanged.
    The handlers of ROS 2 would end ROS at Ctrl-C before the task has stopped, and would ignore
    SIGTERM.
    """
    if not rclpy.ok():
        nothing = importlib.import_module("rclpy.signals").SignalHandlerOptions.NO
        rclpy.init(signal_handler_options=nothing)


class Messages:
    """Snapshots as messages. `now` returns the ROS time in the format of the messages."""

    def __init__(
        self,
        messages: Any,
        publish: Callable[[Any], object],
        now: Callable[[], Any],
        clock: Callable[[], float],
    ) -> None:
        self._messages, self._publish = messages, publish
        self._now, self._clock = now, clock
        self._since: dict[str, Any] = {}

    def publish(self, snapshot: Snapshot) -> None:
        """Send a snapshot."""
        message = self._messages.SkillContext()
        message.header.stamp = now = self._now()
        message.digest = snapshot.digest
        goals = {each.goal for each in snapshot.running}
        self._since = {goal: since for goal, since in self._since.items() if goal in goals}
        message.running = [self._running(each, now) for each in snapshot.running]
        message.ahead = [self._ahead(each) for each in snapshot.ahead or ()]
        message.is_ahead_known = snapshot.ahead is not None
        self._publish(message)

    def _ahead(self, found: SkillAhead) -> Any:
        message = self._messages.SkillAhead()
        message.skill = found.skill
        message.arguments = list(map(self._argument, found.arguments))
        return message

    def _running(self, found: RunningSkill, now: Any) -> Any:
        message = self._messages.RunningSkill()
        message.skill, message.goal = found.skill, found.goal
        if found.goal not in self._since:
            self._since[found.goal] = earlier(now, self._clock() - found.since)
        message.since = self._since[found.goal]
        message.arguments = list(map(self._argument, found.arguments))
        for permitted in found.permits:
            permission = self._messages.SkillPermission()
            permission.kind, permission.type = permitted.kind, permitted.type
            permission.limit = permitted.limit
            message.permits.append(permission)
        return message

    def _argument(self, found: SkillArgument) -> Any:
        argument = self._messages.SkillArgument()
        argument.parameter, argument.value = found.parameter, found.value
        argument.type, argument.number = found.type, found.number
        for each in found.properties:
            known = self._messages.SkillProperty()
            known.property, known.number = each.property, each.number
            argument.properties.append(known)
        return argument


def earlier(now: Any, seconds: float) -> Any:
    """The ROS time some seconds before another one, at least 0."""
    is_ros1 = hasattr(now, "nsecs")
    whole, rest = (now.secs, now.nsecs) if is_ros1 else (now.sec, now.nanosec)
    nanoseconds = max(0, whole * 10**9 + rest - round(max(0.0, seconds) * 1e9))
    return type(now)(*divmod(nanoseconds, 10**9)) if is_ros1 else _stamp(now, nanoseconds)


def _stamp(now: Any, nanoseconds: int) -> Any:
    found = type(now)()
    found.sec, found.nanosec = divmod(nanoseconds, 10**9)
    return found
