"""Frames under attack: two robots on one machine, a restart in the middle, a clock that stops."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from rossmarie.driver import compile_file
from support.live import Ears, Process, Robot, Ros, Wanted, until

RULES = Path(__file__).parents[1] / "support" / "frames.ross"
NAMESPACES = ("/robot1", "/robot2")
ALL = {"beside", "turned", "far"}
SEEN = {"far"}
"""The rule that is active where the robot stands far away and all frames are known: the hand lies
straight before the camera, and the camera looks along the head.
"""


def needs(_generation: str) -> Sequence[Wanted]:
    """The node of rules that see a hand from other frames."""
    return [compile_file(RULES).machine]


pytestmark = [pytest.mark.builds(by=needs)]


class Fleet:
    """Robots that say where they are, and what hears their nodes."""

    def __init__(self, ros: Ros, program: Path, folder: Path, processes: list[Process]) -> None:
        self._ros, self._program, self._folder = ros, program, folder
        self._processes = processes
        self._package = program.parent.name
        topics = [f"{space}/{self._package}/state" for space in ("", *NAMESPACES)]
        kind = ros.ros_type(f"{self._package}/State")
        self._ears: Ears = ros.ears(*[word for topic in topics for word in (topic, kind)])
        processes.append(self._ears)

    def stands(self, space: str, x: float) -> Process:
        """Say all the time where a robot stands, and what it sees; gives what says the first."""
        self.mounts(space)
        return self.moves(space, x)

    def mounts(self, space: str) -> None:
        """Say once where the camera is mounted."""
        self._say(space, "tf_static", "tf2_msgs/TFMessage", _frames(("head", "camera", 0.0)), True)

    def moves(self, space: str, x: float) -> Process:
        """Say all the time what changes: where a robot stands, and what it sees."""
        hand = {"header": {"frame_id": "camera"}, "pose": _pose(1.0)}
        self._say(space, "hand", "geometry_msgs/PoseStamped", hand)
        moving = _frames(("odom", "base_link", x), ("base_link", "head", 0.0))
        return self._say(space, "tf", "tf2_msgs/TFMessage", moving)

    def begin(self, space: str, **options: Any) -> Process:
        """Start the node of a robot, which hears the transforms of its namespace only."""
        parameters = {"state_file": str(self._folder / f"latched{space.strip('/')}")}
        own = [f"/{topic}:={space}/{topic}" for topic in ("tf", "tf_static") if space]
        process = self._ros.begin(
            self._program, parameters, namespace=space, remapped=own, **options
        )
        self._processes.append(process)
        return process

    def active(self, space: str) -> set[str] | None:
        """The rules that a node says are active; None before it says so."""
        state = self._ears.last(f"{space}/{self._package}/state")
        return None if state is None else set(state["active"])

    def forget(self, space: str) -> None:
        """Forget the state that a node has reported."""
        self._ears.ask(forget=f"{space}/{self._package}/state")

    def becomes(self, space: str, rules: set[str]) -> None:
        """Wait until these rules are active, and no others."""
        try:
            until(lambda: self.active(space) == rules, f"{space} has {rules}")
        except AssertionError as error:
            said = "\n".join(process.said() for process in self._processes)
            state = self._ears.last(f"{space}/{self._package}/state")
            raise AssertionError(f"{error}, not {state}\n{said}") from error

    def _say(
        self, space: str, topic: str, kind: str, message: object, is_kept: bool = False
    ) -> Process:
        found = self._ros.publish(
            20, f"{space}/{topic}", kind, json.dumps(message), is_kept=is_kept
        )
        self._processes.append(found)
        return found


@pytest.fixture
def fleet(ros: Ros, programs: Sequence[Path], tmp_path: Path, started: list[Process]) -> Fleet:
    return Fleet(ros, programs[0], tmp_path, started)


def test_frames_of_one_robot_are_not_those_of_the_other(fleet: Fleet) -> None:
    one, other = NAMESPACES
    position = fleet.stands(one, 0.5)
    fleet.stands(other, 5.0)
    for space in NAMESPACES:
        fleet.begin(space)
    near = {"beside", "turned"}
    fleet.becomes(one, near)
    fleet.becomes(other, near | SEEN)
    position.end()
    fleet.becomes(one, ALL)
    assert fleet.active(other) == near | SEEN


def test_a_node_that_starts_again_hears_frames_that_were_said_before(fleet: Fleet) -> None:
    fleet.stands("", 0.5)
    node = fleet.begin("")
    fleet.becomes("", {"beside", "turned"})
    node.end()
    fleet.forget("")
    fleet.begin("")
    fleet.becomes("", {"beside", "turned"})


def test_a_frame_counts_that_was_said_once_long_before_the_others(fleet: Fleet) -> None:
    fleet.mounts("")
    fleet.begin("")
    fleet.becomes("", ALL)  # the node has waited for its inputs as long as it does
    fleet.moves("", 0.5)
    fleet.becomes("", {"beside", "turned"})


def test_frames_that_come_while_the_clock_stands_still_do_not_count(
    fleet: Fleet, robot: Robot
) -> None:
    """The simulation stops; whoever says where the robot is does not notice."""
    robot.set(clock=1000.0)
    fleet.stands("", 0.5)
    fleet.begin("", use_sim_time=True)
    fleet.becomes("", {"beside", "turned"})
    robot.set(clock=None)
    fleet.becomes("", ALL)


def _frames(*joints: tuple[str, str, float]) -> dict[str, Any]:
    return {
        "transforms": [
            {
                "header": {"frame_id": parent},
                "child_frame_id": child,
                "transform": {
                    "translation": {"x": x, "y": 0.0, "z": 0.0},
                    "rotation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0},
                },
            }
            for parent, child, x in joints
        ]
    }


def _pose(x: float) -> dict[str, Any]:
    orientation = {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}
    return {"position": {"x": x, "y": 0.0, "z": 0.0}, "orientation": orientation}
