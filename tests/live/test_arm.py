"""Listing 1 of the thesis, corrected, on a simulated arm."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from support.live import Ears, Ros, Wanted, until
from support.live_cases import patient

THESIS = Path(__file__).parents[2] / "examples" / "thesis"
STATE = "/arm_safety/state"
STIFFNESS = "/arm_controller/stiffness"


def needs(_generation: str) -> Sequence[Wanted]:
    """The node of the listing, and the messages of the arm."""
    return patient(THESIS / "arm.ross"), THESIS / "msg" / "heron_msgs"


pytestmark = [pytest.mark.builds(by=needs), pytest.mark.deep]


@pytest.fixture
def placing(ros: Ros, programs: Sequence[Path], tmp_path: Path) -> Iterator[Ears]:
    """An arm that places something, and the node."""
    arm = ros.ears(script="arm.py")
    node = ros.begin(programs[0], {"state_file": str(tmp_path / "latched")})
    try:
        arm.ask(goal="placed")
        follows(arm, ["begins", "placed"])
        yield arm
    finally:
        node.end()
        arm.end()


def follows(arm: Ears, *events: list[str]) -> None:
    """Wait until these are the last that have happened to the arm."""
    until(lambda: arm.heard("/arm")[-len(events) :] == list(events), f"{events}")


def is_released(arm: Ears) -> bool:
    reported = arm.last(STATE)
    return reported is not None and reported["active"] == []


def test_an_arm_that_oscillates_is_retracted_and_tries_again(placing: Ears) -> None:
    placing.set(touches=True, gives_way=True)
    follows(
        placing,
        ["is cancelled", "placed"],
        ["begins", "retracted"],
        ["succeeds", "retracted"],
        ["begins", "placed"],
    )
    until(lambda: placing.heard(STIFFNESS) == [200.0, 1000.0], "it is as stiff as before")
    softened = placing.ask(heard=STIFFNESS)[0][0]
    cancelled, retracting = (at for at, _ in placing.ask(heard="/arm")[1:3])
    stands = min(at for at, speed in placing.ask(heard="speed") if at > cancelled and speed == 0.0)
    assert stands < softened < retracting
    until(lambda: is_released(placing), "its state is reported")
    assert placing.heard("/arm/stop") == []


def test_an_arm_that_moves_on_although_it_accepts_the_cancel_is_stopped(placing: Ears) -> None:
    placing.set(touches=True, obeys=False)
    until(lambda: placing.last("/arm/stop") is True, "it is stopped")
    assert placing.heard("/arm")[1:] == [["is cancelled", "placed"]]
    assert placing.heard(STIFFNESS) == []
    placing.set(touches=False)
    until(lambda: is_released(placing), "the force is calm")
    placing.silent("/arm/stop")
    assert placing.heard("/arm")[1:] == [["is cancelled", "placed"]]
