"""An experiment of Heron goes with the generated node on guard as it goes in one process."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from heron.experiments import run_navigation
from heron.experiments.arms import NAVIGATION_RULES, machine_of
from heron.ros1 import Ros1Error, Ros1Link
from heron.tasks import Status, TreeSkill
from heron.variants import ExperimentArm, Terrain
from support.live import LIMIT, Process, Wanted, until
from support.ros1_live import Ros1

SEED = 3

_ON_BOTH = {
    *("slow_on_bump activated", "slow_on_bump cleared"),
    *("push_on_gentle_slope activated", "push_on_gentle_slope cleared"),
}
EXPECTED = {
    Terrain.GENTLE: _ON_BOTH,
    Terrain.STEEP: {
        *_ON_BOTH,
        *("back_off_steep_ramp activated", "back_off_steep_ramp cleared"),
    },
}
"""The effects of the rules: they limit and boost; on the steep ramp they replan and command instead
of the program.
"""

NEAR = 0.3
"""Seconds by which instants may differ: what the node says counts from the end of an instant on,
so the drive hears it up to a period later than from a guard in its own process.
"""


def needs(_generation: str) -> Sequence[Wanted]:
    """The node of the rules of experiment I."""
    return [machine_of(NAVIGATION_RULES[ExperimentArm.ROSSMARIE])]


pytestmark = [pytest.mark.deep, pytest.mark.builds(by=needs)]


@pytest.mark.parametrize("terrain", [Terrain.GENTLE, Terrain.STEEP])
def test_an_experiment_has_the_same_outcome(
    ros1: Ros1,
    programs: Sequence[Path],
    terrain: Terrain,
    started: list[Process],
    tmp_path: Path,
) -> None:
    here = run_navigation(ExperimentArm.ROSSMARIE, terrain, SEED)
    begin(ros1, programs[0], started, tmp_path)
    with closing(Ros1Link(ros1.variables["ROS_MASTER_URI"], "127.0.0.1")) as link:
        there = run_navigation(ExperimentArm.ROSSMARIE, terrain, SEED, link=link)
    assert verdicts(there.reported) == [
        (words, pytest.approx(at_s, abs=NEAR)) for words, at_s in verdicts(here.reported)
    ]
    assert {words for words, _ in verdicts(here.reported)} == EXPECTED[terrain]
    assert there.outcome is here.outcome
    assert there.measures.is_completed
    assert there.measures.is_completed == here.measures.is_completed
    assert there.measures.replanned == here.measures.replanned
    assert here.measures.replanned == (terrain is Terrain.STEEP)
    assert there.measures.reactions == pytest.approx(here.measures.reactions, abs=NEAR)
    assert there.measures.time_restricted == pytest.approx(here.measures.time_restricted, abs=1.0)
    assert outcomes(there.tree) == outcomes(here.tree)


def outcomes(tree: Sequence[TreeSkill]) -> list[tuple[str, list[Status]]]:
    """Skills and what became of them."""
    return [(skill.label, [span.status for span in skill.spans]) for skill in tree]


def verdicts(reported: Sequence[tuple[float, str]]) -> list[tuple[str, Any]]:
    """Rules and what happened to them, with the instants; causes are worded differently."""
    return [(words.partition(":")[0], at_s) for at_s, words in reported]


def test_a_node_that_has_been_on_guard_is_refused(
    ros1: Ros1, programs: Sequence[Path], started: list[Process], tmp_path: Path
) -> None:
    """Time begins at 0, and what it knows of another episode must not count."""
    begin(ros1, programs[0], started, tmp_path)
    state = "/navigation_safety/state"
    ears = ros1.ears(state, "navigation_safety/State")
    started.append(ears)
    started.append(ros1.publish(10, "/clock", "rosgraph_msgs/Clock", "{clock: {secs: 5}}"))
    until(lambda: ears.last(state) is not None, "the node has begun")
    with (
        closing(Ros1Link(ros1.variables["ROS_MASTER_URI"], "127.0.0.1")) as link,
        pytest.raises(Ros1Error, match="on guard before: start it anew"),
    ):
        run_navigation(ExperimentArm.ROSSMARIE, Terrain.FLAT, SEED, link=link)


def begin(ros1: Ros1, program: Path, started: list[Process], folder: Path) -> None:
    """A new node on guard."""
    parameters = {"state_file": str(folder / "latched"), "clock_timeout": LIMIT}
    started.append(ros1.begin(program, parameters, use_sim_time=True))
