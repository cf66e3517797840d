"""Real SkiROS2 for live tests: a world model and a skill manager, in processes of their own."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from support.live import Process, talking, until
from support.ros1_live import Ros1, set_parameters

_START = Path(__file__).with_name("skiros2_start.py")


@dataclass(frozen=True)
class Robot:
    """A workspace of SkiROS2, and the skills of a library; `begins` is started, with individuals by
    their labels: `Object=cable`.
    """

    workspace: Path
    scene: str
    library: str
    skills: Sequence[str]
    begins: Sequence[str]


class SkiROS2:
    """All processes are among those that were `started`."""

    def __init__(self, ros: Ros1, robot: Robot, log: Path, started: list[Process]) -> None:
        self._ros, self._robot, self._log, self._started = ros, robot, log, started
        own = {key: ros.variables[key] for key in ("ROS_MASTER_URI", "ROS_IP", "ROS_LOG_DIR")}
        places = [ros.variables["PYTHONPATH"], str(robot.workspace), os.environ["PYTHONPATH"]]
        paths = ":".join(filter(None, [*places, *sys.path]))
        self.variables = {**os.environ, **own, "PYTHONPATH": paths}
        set_parameters(
            ros.variables,
            "wm",
            {"workspace_dir": str(robot.workspace), "init_scene": robot.scene},
            use_sim_time=False,
        )
        self._node("skiros2_world_model", "world_model_server_node", "wm")
        self.begin()

    def begin(self) -> None:
        """Start the skill manager, and a skill in it."""
        values = {
            "prefix": "skiros",
            "verbose": False,
            "libraries_list": [self._robot.library],
            "skill_list": list(self._robot.skills),
        }
        set_parameters(self._ros.variables, "heron", values, use_sim_time=False)
        self.manager = self._node("skiros2_skill", "skill_manager_node", "heron")
        command = [sys.executable, str(_START), "/heron", *self._robot.begins]
        starter = Process(command, self.variables, self._log / "starter.log", talking)
        self._started.append(starter)
        until(lambda: "started" in starter.said(), f"{self._robot.begins[0]} starts")

    def _node(self, package: str, program: str, name: str) -> Process:
        folders = [Path(each) for each in os.environ["ROS_PACKAGE_PATH"].split(":")]
        path = next(
            each / package / "nodes" / program for each in folders if (each / package).is_dir()
        )
        command = [sys.executable, str(path), f"__name:={name}"]
        node = Process(command, self.variables, self._log / f"{name}.log", talking)
        self._started.append(node)
        return node
