"""The messages of a robot over ROS 1 or ROS 2, whichever this Python has. Neither is imported
before it is needed.
"""

from __future__ import annotations

import importlib
import queue
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from crosscheck.live.facts import Facts
from crosscheck.live.model import Alive, Message
from crosscheck.live.reading import context_of, is_alive, state_of
from ezskiros.context.ros import ros2_spun, ros_libraries

_NODE = "crosscheck_live"
_MOST_WAITING = 1000
"""The most messages that wait here. ROS keeps the others."""
_LONGEST_WAIT = 1.0
"""The seconds for which a message waits for a free place."""
_LONGEST_SPIN = 0.2
"""The seconds for which ROS 2 waits for a message before it checks for the end."""

Read = Callable[[Any], Message | None]
Take = Callable[[Any], None]


class NotObservedError(Exception):
    """The robot cannot be observed. The text gives the reason."""


@dataclass(frozen=True)
class Topic:
    """A subscribed topic. If it is `kept`, later subscribers receive the last message, too."""

    name: str
    type: Any
    read: Read
    is_kept: bool = False


@dataclass
class Ears:
    """Received messages with their times, by `time.monotonic`."""

    heard: queue.Queue[tuple[float, Message]]
    end: Callable[[], object]

    def next(self, seconds: float) -> tuple[float, Message] | None:
        """The next message; None if none arrives within some seconds."""
        try:
            return self.heard.get(timeout=seconds)
        except queue.Empty:
            return None


def listen(facts: Facts) -> Ears:
    """Subscribe to a robot. Raises `NotObservedError`."""
    library, topics = _found(facts)
    ears = Ears(queue.Queue(_MOST_WAITING), lambda: None)

    def taking(read: Read) -> Take:
        def take(message: Any) -> None:
            found = read(message)
            if found is not None:
                with suppress(queue.Full):  # from now on nothing reads the queue
                    ears.heard.put((time.monotonic(), found), timeout=_LONGEST_WAIT)

        return take

    begin = _ros1 if library.__name__ == "rospy" else _ros2
    ears.end = begin(library, [(topic, taking(topic.read)) for topic in topics])
    return ears


def _found(facts: Facts) -> tuple[Any, list[Topic]]:
    """The library of this ROS generation, and the topics with their message types. Raises
    `NotObservedError`, which names everything that is missing.
    """
    missing = []
    libraries = ros_libraries()
    library = next((found for name in libraries if (found := _imported(name))), None)
    if library is None:
        missing.append(f"neither {' nor '.join(libraries)}")
    packages = ("skill_context_msgs", facts.package, "diagnostic_msgs")
    messages = {name: _imported(f"{name}.msg") for name in packages}
    missing += [name for name, found in messages.items() if found is None]
    if library is None or missing:
        lacking = ", ".join(missing)
        raise NotObservedError(
            f"ROS packages are missing for this Python: {lacking}; source their workspace"
        )
    context, state, diagnostics = messages.values()
    return library, [
        Topic(facts.topic, context.SkillContext, context_of),
        Topic(f"{facts.node}/state", state.State, state_of, is_kept=True),
        Topic("/diagnostics", diagnostics.DiagnosticArray, _life_of(facts.node)),
    ]


def _life_of(node: str) -> Read:
    return lambda message: Alive() if is_alive(message, node) else None


def _imported(name: str) -> Any:
    """A module of ROS; None if it is missing."""
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


def _ros1(rospy: Any, topics: list[tuple[Topic, Take]]) -> Callable[[], object]:
    if not importlib.import_module("rosgraph").is_master_online():
        raise NotObservedError("no ROS master answers")
    # Times are from the monotonic clock of this machine, so /use_sim_time has no effect.
    rospy.init_node(_NODE, argv=[_NODE], anonymous=True, disable_signals=True)
    for topic, take in topics:
        rospy.Subscriber(topic.name, topic.type, take, tcp_nodelay=True)
    return lambda: rospy.signal_shutdown("crosscheck ends")


def _ros2(rclpy: Any, topics: list[tuple[Topic, Take]]) -> Callable[[], object]:
    qos = importlib.import_module("rclpy.qos")
    handlers = importlib.import_module("rclpy.signals").SignalHandlerOptions
    rclpy.init(args=[], signal_handler_options=handlers.NO)
    node = rclpy.create_node(_NODE)
    for topic, take in topics:
        profile = qos.QoSProfile(depth=10)
        if topic.is_kept:
            profile = qos.QoSProfile(depth=1, durability=qos.DurabilityPolicy.TRANSIENT_LOCAL)
        node.create_subscription(topic.type, topic.name, take, profile)
    stop = ros2_spun(node, _LONGEST_SPIN)

    def end() -> None:
        stop()
        rclpy.try_shutdown()

    return end
