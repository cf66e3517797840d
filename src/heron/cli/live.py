"""Experiment I with a guard node on ROS 1, and new nodes."""

from __future__ import annotations

import os
from collections.abc import Sequence
from contextlib import closing

from dslkit.command_line import CommandLine
from heron.cli.episodes import print_episode
from heron.experiments import Observer, run_navigation
from heron.experiments.table import NAVIGATION
from heron.ros1 import Ros1Error, Ros1Link
from heron.ros1.node import Ros1Node
from heron.variants import ExperimentArm, Terrain

_MASTER = "http://localhost:11311"


def run_live(
    output: CommandLine,
    arm: ExperimentArm,
    terrain: Terrain,
    seed: int,
    observers: Sequence[Observer],
) -> None:
    """The guard is a separate node."""
    try:
        with closing(Ros1Link(*_place())) as link:
            episode = run_navigation(arm, terrain, seed, observers, link=link)
    except Ros1Error as error:
        output.fail(str(error), exit_code=1)
    print_episode(NAVIGATION, episode)


def node_of(name: str) -> Ros1Node:
    """A new node. Raises `Ros1Error` if there is no master."""
    return Ros1Node(name, *_place())


def _place() -> tuple[str, str]:
    """Master and address of this machine are where ROS has them: in the environment."""
    master = os.environ.get("ROS_MASTER_URI") or _MASTER
    host = os.environ.get("ROS_IP") or os.environ.get("ROS_HOSTNAME") or "localhost"
    return master, host
