"""A policy that was learned behind rules runs behind the node that is built from the same file.

The arm, the policy and the node are processes of their own, in real time. In the place of the node,
a relay that lets everything pass shows what the policy does without it.
"""

from __future__ import annotations

import json
import os
import re
import sys
import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing, contextmanager, suppress
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from heron.learning.arms import RULES
from heron.learning.environment import GREATEST, LEAST
from heron.learning.on_topics import PUSH, VELOCITY
from heron.learning.policy import INPUTS, Policy
from heron.operation.live_policy import WANTED_PUSH, WANTED_VELOCITY
from heron.ros1 import Ros1Error
from heron.ros1.node import Ros1Node
from heron.scene.insertion import InsertionParameters
from heron.topics import Topic
from rossmarie.driver import compile_file
from support.live import LIMIT, Process, Wanted, talking, until
from support.ros1_live import Ros1

FRAGILE = np.array([-0.5, 0.3, 0.75])
GOOD = {
    "Height": 0.067,
    "AsideX": 0.0,
    "AsideY": 0.0,
    "Force": 6.5,
    "Growth": 0.004,
    "Speed": 0.065,
}
"""Numbers of the tree as a training behind the rules finds them."""
SEED = 5
"""The seed of an episode in which nobody comes."""


def needs(_generation: str) -> Sequence[Wanted]:
    """The node of the rules of the training."""
    return [compile_file(RULES).machine]


pytestmark = [pytest.mark.builds(by=needs)]


def into_the_fragile_part() -> bytes:
    """A policy file: it goes for what must not be touched, as fast as it can, and pushes."""
    weights = np.zeros((INPUTS, 4))
    weights[:3, :3] = -3.0 * np.eye(3)  # of places scaled by 0.3 m, to parts of 0.3 m/s
    bias = np.append(10.0 * (FRAGILE - np.array(InsertionParameters().hole)), -0.5)
    return Policy([(weights, bias)], (LEAST.tolist(), GREATEST.tolist())).file()


@pytest.fixture
def guard(ros1: Ros1, programs: Sequence[Path], started: list[Process], tmp_path: Path) -> Process:
    """The generated node, in real time."""
    parameters = {"state_file": str(tmp_path / "latched"), "patience": LIMIT}
    started.append(ros1.begin(programs[0], parameters))
    return started[-1]


@pytest.mark.usefixtures("guard")
def test_the_peg_is_inserted_behind_the_node(
    ros1: Ros1, started: list[Process], tmp_path: Path
) -> None:
    numbers = tmp_path / "numbers.json"
    numbers.write_text(json.dumps(GOOD), encoding="utf-8")
    reported = episode(ros1, started, numbers, tmp_path)
    assert reported["task"] == "inserted"
    assert reported["violations"] == "none"


@pytest.mark.usefixtures("guard")
def test_the_node_keeps_a_policy_off_the_fragile_part(
    ros1: Ros1, started: list[Process], tmp_path: Path
) -> None:
    reported = episode(ros1, started, reckless(tmp_path), tmp_path)
    assert reported["force on the fragile part"] == "0 N"
    assert "touched" not in reported["violations"]


@pytest.mark.deep
def test_without_the_node_the_policy_hits_it(
    ros1: Ros1, started: list[Process], tmp_path: Path
) -> None:
    with relay(ros1):
        reported = episode(ros1, started, reckless(tmp_path), tmp_path)
    assert "touched" in reported["violations"]


@pytest.mark.deep
@pytest.mark.usefixtures("guard")
def test_the_arm_stands_still_when_its_policy_ends(
    ros1: Ros1, started: list[Process], tmp_path: Path
) -> None:
    arm, policy = begin(ros1, started, reckless(tmp_path), tmp_path)
    with closing(Ros1Node("/test", ros1.variables["ROS_MASTER_URI"], "127.0.0.1")) as node:
        places: list[float] = []
        node.subscribe("/arm/pose", "geometry_msgs/Point", lambda place: places.append(place.y))
        node.wait_while(lambda: None if node.hears("/arm/pose") else "no arm")

        def has_moved() -> bool:
            node.deliver()
            return bool(places) and max(places) - min(places) > 0.05

        until(has_moved, "the policy moves the arm")
        policy.end()
        places.clear()

        def stands() -> bool:
            node.deliver()
            return len(places) > 250 and np.ptp(places[-125:]) < 0.001

        until(stands, "the arm stands still")
        assert arm.running.poll() is None


def test_readings_of_another_type_are_refused(
    ros1: Ros1, started: list[Process], tmp_path: Path
) -> None:
    with closing(Ros1Node("/other", ros1.variables["ROS_MASTER_URI"], "127.0.0.1")) as node:
        node.advertise(Topic("/arm/pose", "geometry_msgs/Twist"))
        policy = heron(ros1, started, tmp_path, "policy", str(reckless(tmp_path)))
        until(lambda: policy.running.poll() is not None, "the policy refuses")
    assert policy.running.poll() == 1
    reported = "/other publishes /arm/pose as geometry_msgs/Twist, not geometry_msgs/Point"
    assert reported in policy.said()


def reckless(folder: Path) -> Path:
    """The file of a policy that goes for the fragile part."""
    path = folder / "policy.npz"
    path.write_bytes(into_the_fragile_part())
    return path


def episode(ros1: Ros1, started: list[Process], policy: Path, folder: Path) -> Mapping[str, str]:
    """Run an episode; gives the measures that the arm prints, by their names."""
    arm, _ = begin(ros1, started, policy, folder)
    until(lambda: arm.running.poll() is not None, "the episode is over")
    said = arm.said()
    assert arm.running.poll() == 0, said
    return dict(re.findall(r"│ (.+?) +│ +(.+?) +│", said))


def begin(
    ros1: Ros1, started: list[Process], policy: Path, folder: Path
) -> tuple[Process, Process]:
    """The arm and the policy."""
    arm = heron(ros1, started, folder, "run", "insertion", "--ros1", "--seed", str(SEED))
    return arm, heron(ros1, started, folder, "policy", str(policy))


def heron(ros1: Ros1, started: list[Process], folder: Path, *words: str) -> Process:
    """A command, as a process of its own."""
    names = ("ROS_MASTER_URI", "ROS_IP")
    variables = os.environ | {name: ros1.variables[name] for name in names}
    log = folder / f"{words[0]}.log"
    started.append(Process([sys.executable, "-m", "heron", *words], variables, log, talking))
    return started[-1]


@contextmanager
def relay(ros1: Ros1) -> Iterator[None]:
    """Relay the commands of a policy to the arm without a change."""
    is_over = threading.Event()
    with closing(Ros1Node("/relay", ros1.variables["ROS_MASTER_URI"], "127.0.0.1")) as node:
        for wanted, passed in ((WANTED_VELOCITY, VELOCITY), (WANTED_PUSH, PUSH)):
            node.advertise(passed)
            node.subscribe(wanted.name, wanted.type, partial(node.publish, passed))

        def run() -> None:
            with suppress(Ros1Error):  # the policy has ended
                while not is_over.wait(0.002):
                    node.connect()
                    node.deliver()

        thread = threading.Thread(target=run)
        thread.start()
        try:
            yield
        finally:
            is_over.set()
            thread.join()
