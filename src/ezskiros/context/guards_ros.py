"""The active rules, over ROS 1 or ROS 2. ROS packages are only imported on first use."""

from __future__ import annotations

import importlib
import threading
from collections.abc import Callable
from types import ModuleType
from typing import Any

from ezskiros.context.guards import ActiveRules, Guards
from ezskiros.context.ros import NoRosError, ros2_node, ros2_spun, ros_library

_NODE = "ezskiros_guards"
_LOOK = 0.05
"""The seconds between two checks for the node of the rules."""
_DIAGNOSTICS = "/diagnostics"

Stop = Callable[[], object]
"""Ends the subscription."""


def listen(guards: Guards, rules: ActiveRules) -> Stop:
    """Subscribe to the node of the rules. Raises `NoRosError`."""
    name, library = ros_library()
    package, _, kind = guards.type.partition("/")
    state = getattr(_messages(package), kind, None)
    if state is None:
        raise NoRosError(f"the package `{package}` has no message type `{kind}`")
    diagnostics = _messages("diagnostic_msgs").DiagnosticArray
    heard = _in_ros1 if name == "rospy" else _in_ros2
    return heard(library, guards, rules, state, diagnostics)


def _messages(package: str) -> Any:
    try:
        return importlib.import_module(f"{package}.msg")
    except ImportError:
        raise NoRosError(f"the package `{package}` is not installed") from None


def signs(rules: ActiveRules, node: str) -> Callable[[Any], None]:
    """A subscriber to diagnostics. A status from the node with this full name is a heartbeat."""
    name = node.removeprefix("/")

    def hear(message: Any) -> None:
        if any(each.hardware_id == name for each in message.status):
            rules.hear_sign()

    return hear


def _in_ros1(
    rospy: ModuleType, guards: Guards, rules: ActiveRules, state: Any, diagnostics: Any
) -> Stop:
    if not importlib.import_module("rosgraph").is_master_online():
        raise NoRosError("no ROS master answers")
    if not rospy.core.is_initialized():
        rospy.init_node(_NODE, anonymous=True, disable_signals=True)
    reported = rospy.Subscriber(guards.topic, state, rules.hear_state, tcp_nodelay=True)
    hear = signs(rules, rospy.resolve_name(guards.node))
    diagnosed = rospy.Subscriber(_DIAGNOSTICS, diagnostics, hear, tcp_nodelay=True)
    has_ended = threading.Event()

    def look() -> None:
        while not has_ended.wait(_LOOK):
            before = rules.clock()
            if not is_connected(reported):
                rules.lose(before)

    threading.Thread(target=look, daemon=True).start()

    def stop() -> None:
        has_ended.set()
        reported.unregister()
        diagnosed.unregister()

    return stop


def is_connected(subscriber: Any) -> bool:
    """Say whether a ROS 1 subscriber has a publisher. ROS 1 keeps a connection without a socket
    after a reset and tries to reconnect; `get_num_connections` counts such a connection as well.
    """
    connections = subscriber.impl.connections if subscriber.impl else ()
    return any(getattr(each, "socket", each) is not None for each in connections)


def _in_ros2(
    rclpy: ModuleType, guards: Guards, rules: ActiveRules, state: Any, diagnostics: Any
) -> Stop:
    qos = importlib.import_module("rclpy.qos")
    node = ros2_node(rclpy, _NODE)
    kept = qos.QoSProfile(depth=1, durability=qos.DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_subscription(state, guards.topic, rules.hear_state, kept)
    hear = signs(rules, f"{node.get_namespace().rstrip('/')}/{guards.node}")
    node.create_subscription(diagnostics, _DIAGNOSTICS, hear, qos.QoSProfile(depth=10))

    def look() -> None:
        before = rules.clock()
        if node.count_publishers(guards.topic) == 0:
            rules.lose(before)

    return ros2_spun(node, _LOOK, look)
