"""Listing 2 of the thesis, corrected, on a simulated drive."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from rossmarie.driver import compile_file
from support.live import Ears, Ros, until

RULES = Path(__file__).parents[2] / "examples" / "thesis" / "mobile_base.ross"
STATE = "/mobile_base_safety/state"
LONG = 30.0
"""Seconds; conditions have to hold for 4 s, and the drive has to gain speed."""


@pytest.fixture(scope="session")
def program(ros: Ros) -> Path:
    """The node of the listing."""
    return ros.build(compile_file(RULES).machine)


@pytest.fixture
def drive(ros: Ros, program: Path, tmp_path: Path) -> Iterator[Ears]:
    """A drive on level ground that is to go at 0.4 m/s, and the node."""
    found = ros.ears(script="drive.py")
    node = ros.begin(program, {"state_file": str(tmp_path / "latched")})
    try:
        until(lambda: found.last("/cmd_vel") == 0.4, "commands flow")
        yield found
    finally:
        node.end()
        found.end()


def test_a_slope_is_climbed_with_more_torque(drive: Ears) -> None:
    drive.set(pitch=15.0)
    until(lambda: drive.last("/drive/boost") is True, "more torque is asked for", LONG)
    assert drive.last(STATE)["active"] == ["rule_1"]
    until(lambda: drive.last("/cmd_vel") == 0.4, "commands still flow")
    drive.ask(forget="/drive/boost")
    until(lambda: drive.last("/drive/boost") is True, "it is asked for again and again")
    drive.set(pitch=0.0)
    until(lambda: drive.last(STATE)["active"] == [], "the slope is over")
    time.sleep(0.5)
    drive.ask(forget="/drive/boost")
    time.sleep(0.5)
    assert drive.heard("/drive/boost") == []


def test_a_ramp_is_left_backwards_and_then_commands_flow_again(drive: Ears) -> None:
    drive.set(pitch=25.0)
    drive.ask(forget="/cmd_vel")
    until(lambda: drive.last("/cmd_vel") == -0.1, "it moves back", LONG)
    until(lambda: drive.last("speed") < 0.05, "it moves back")
    drive.set(pitch=0.0)
    until(lambda: drive.last("/cmd_vel") == 0.4, "commands flow again")
    assert drive.last(STATE)["active"] == []
    told = drive.heard("/cmd_vel")
    after = told[told.index(-0.1) :]
    back = [speed for speed in after if speed < 0.0]
    assert set(back) == {-0.1}
    assert len(back) > 3, "again and again, until it moves no more"
    assert after[: len(back)] == back, "nothing of the planner's comes between"
    gentle = after[len(back) :]
    assert 0.2 <= gentle[0] < 0.4
    assert gentle == sorted(gentle)


def test_high_speed_is_limited_until_it_is_over(drive: Ears) -> None:
    drive.set(wanted=0.8)
    until(lambda: drive.last("/cmd_vel") == 0.8, "0.8 m/s is commanded")
    until(lambda: drive.last("/cmd_vel") == 0.2, "at most 0.2 m/s passes", LONG)
    until(lambda: drive.last("/cmd_vel") > 0.2, "the limit is lifted")
    assert drive.last("speed") <= 0.5
    drive.set(wanted=0.4)
    until(lambda: drive.last("/cmd_vel") == 0.4, "commands flow again")
