"""The listing of section 6.3 of the thesis, corrected, on a simulated arm."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path

import pytest

from support.live import Ears, Process, Ros, Wanted, until
from support.live_cases import patient

ROOT = Path(__file__).parents[2]
THESIS = ROOT / "examples" / "thesis"
STATE = "/peg_in_hole_safety/state"
EDGE = 0.1
"""The end of the volume along x, in m."""


def needs(generation: str) -> Sequence[Wanted]:
    """The node of the listing, the messages of the robot, and the program that tells the listing
    of skills.
    """
    packages = ROOT / "ros" / generation
    listing = patient(THESIS / "peg_in_hole.ross")
    messages = THESIS / "msg" / "heron_msgs", packages / "skill_context_msgs"
    return listing, *messages, packages / "skill_context_tools"


pytestmark = [pytest.mark.builds(by=needs), pytest.mark.deep]


@pytest.fixture
def running(ros: Ros, programs: Sequence[Path], tmp_path: Path) -> Iterator[tuple[Ears, Process]]:
    """An arm whose skill moves it, and the node."""
    arm = ros.ears(script="peg.py")
    node = ros.begin(programs[0], {"state_file": str(tmp_path / "latched")})
    try:
        yield arm, node
    finally:
        node.end()
        arm.end()


def active(arm: Ears) -> list[str] | None:
    reported = arm.last(STATE)
    return None if reported is None else list(reported["active"])


def test_an_arm_that_leaves_its_volume_goes_back_the_way_it_came(
    running: tuple[Ears, Process],
) -> None:
    arm, node = running
    arm.set(speed=0.1, push=5.0)
    until(lambda: arm.last("/arm/velocity") == 0.1, "the skill moves the arm")
    assert arm.heard("/arm/target") == []
    until(lambda: active(arm) == ["rule_1"], "the arm leaves the volume")
    until(lambda: arm.last("/arm/velocity") == 0.02, "the arm decelerates")
    until(lambda: len(arm.heard("/arm/target")) > 0, "the arm is sent back")
    arm.set(speed=0.0)
    until(lambda: active(arm) == [], "the arm is inside again")
    targets = [target[0] for target in arm.heard("/arm/target")]
    assert targets == sorted(targets, reverse=True)
    assert all(later <= earlier - 0.0049 for earlier, later in pairwise(targets))
    assert EDGE - 0.03 < targets[0] <= EDGE
    assert arm.last("x") <= EDGE
    assert arm.last("/arm/wrench") == 5.0
    until(lambda: "rule rule_1: violated" in node.said(), "the rule is logged")
    arm.silent("/arm/target")


def test_contact_is_allowed_by_the_description_of_the_skill(
    running: tuple[Ears, Process], ros: Ros, programs: Sequence[Path], started: list[Process]
) -> None:
    arm, _ = running
    started.append(ros.begin(programs[3] / "contact_allowed", {}))
    arm.set(speed=0.1, permits=["contact"])
    until(lambda: (arm.last("x") or 0.0) > EDGE + 0.05, "the arm passes the edge of its volume")
    assert active(arm) == []
    assert arm.heard("/arm/target") == []
    arm.set(permits=["speed"])
    until(lambda: active(arm) == ["rule_1"], "another skill runs, and contact is not allowed")
    until(lambda: len(arm.heard("/arm/target")) > 0, "the arm is sent back")
