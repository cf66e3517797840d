"""The action server `recovery` over ROS 1 or ROS 2, to which rules send behavior trees. ROS
packages are only imported on first use.
"""

from __future__ import annotations

import importlib
import threading
from collections.abc import Callable
from types import ModuleType
from typing import Any

from ezskiros.context.ros import NoRosError, ros2_node, ros_library
from ezskiros.engine.interruption import Recovery
from ezskiros.engine.recovery_goals import RecoveryGoals, RefusedGoalError

NAME = "recovery"
_NODE = "ezskiros_recovery"

Stop = Callable[[], object]
"""Ends a server."""


def serve(goals: RecoveryGoals) -> Stop:
    """Accept goals from now on. Raises `NoRosError`."""
    name, library = ros_library()
    served = _in_ros1 if name == "rospy" else _in_ros2
    return served(library, goals)


def _imported(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError:
        raise NoRosError(
            f"`{name.partition('.')[0]}` is not installed, or its version is too old"
        ) from None


def _require_without(kind: Any) -> None:
    if not hasattr(kind(), "without"):
        raise NoRosError("the installed `skill_context_msgs` is too old: it has no field `without`")


# --- ROS 1 ---------------------------------------------------------------------------------------


def _in_ros1(rospy: ModuleType, goals: RecoveryGoals) -> Stop:
    actionlib, messages = _imported("actionlib"), _imported("skill_context_msgs.msg")
    if not hasattr(messages, "RecoverAction"):
        raise NoRosError("the installed `skill_context_msgs` is too old: it has no Recover.action")
    _require_without(messages.RecoverGoal)
    if not importlib.import_module("rosgraph").is_master_online():
        raise NoRosError("no ROS master answers")
    if not rospy.core.is_initialized():
        rospy.init_node(_NODE, anonymous=True, disable_signals=True)

    asked: dict[str, Recovery] = {}

    def begin(handle: Any) -> None:
        goal, name = handle.get_goal(), handle.get_goal_id().id
        handle.set_accepted()

        def done(is_success: bool, why: str) -> None:
            result = messages.RecoverResult(reason=why)
            if is_success:
                handle.set_succeeded(result)
            elif handle.get_goal_status().status == _PREEMPTING:
                handle.set_canceled(result, why)
            else:
                handle.set_aborted(result, why)
            # `begin` has returned: the server handles the two calls one after the other.
            asked.pop(name, None)

        recovery = _begin(goals, goal, done)
        if recovery is not None:
            asked[name] = recovery

    def cancel(handle: Any) -> None:
        recovery = asked.get(handle.get_goal_id().id)
        if recovery is not None:
            recovery.release()

    server = actionlib.ActionServer(NAME, messages.RecoverAction, begin, cancel, auto_start=False)
    server.start()
    return lambda: None  # ends with the node


_PREEMPTING = 6
"""The status of a goal of ROS 1 that is to be cancelled (`actionlib_msgs/GoalStatus`)."""


def _begin(goals: RecoveryGoals, goal: Any, done: Callable[[bool, str], None]) -> Recovery | None:
    """Start the tree of a goal; None if the goal is rejected."""
    given = list(goal.arguments), goal.afterwards, list(goal.without)
    try:
        return goals.begin(goal.digest, goal.skill, *given, done)
    except RefusedGoalError as problem:
        done(False, str(problem))
        return None


# --- ROS 2 ---------------------------------------------------------------------------------------


def _in_ros2(rclpy: ModuleType, goals: RecoveryGoals) -> Stop:
    actions, executors = _imported("rclpy.action"), _imported("rclpy.executors")
    kind = _imported("skill_context_msgs.action").Recover
    _require_without(kind.Goal)
    node = ros2_node(rclpy, _NODE)
    stopped = threading.Event()

    def execute(handle: Any) -> Any:
        ended = threading.Event()
        end: list[tuple[bool, str]] = []

        def done(is_success: bool, why: str) -> None:
            end.append((is_success, why))
            ended.set()

        recovery = _begin(goals, handle.request, done)
        while not ended.wait(_SOON_S) and not stopped.is_set():
            if recovery is not None and handle.is_cancel_requested:
                recovery.release()
        is_success, why = end[0] if end else (False, "no task is running")
        if is_success:
            handle.succeed()
        elif handle.is_cancel_requested:
            handle.canceled()
        else:
            handle.abort()
        return kind.Result(reason=why)

    server = actions.ActionServer(
        node, kind, NAME, execute, cancel_callback=lambda _: actions.CancelResponse.ACCEPT
    )
    executor = executors.MultiThreadedExecutor(_THREADS)
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()

    def stop() -> None:
        stopped.set()  # a request after the last tick would never be answered
        executor.shutdown()
        server.destroy()
        node.destroy_node()

    return stop


_SOON_S = 0.005
_THREADS = 4
"""A goal has a thread until it ends. Another goal that replaces it has a thread as well."""
