"""Listing 2 of the thesis, corrected, on a simulated drive."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import dropwhile, takewhile
from pathlib import Path

import pytest

from support.live import Ears, Ros, Wanted, until
from support.live_cases import patient

RULES = Path(__file__).parents[2] / "examples" / "thesis" / "mobile_base.ross"
STATE = "/mobile_base_safety/state"


def needs(_generation: str) -> Sequence[Wanted]:
    """The node of the listing."""
    return [patient(RULES)]


pytestmark = [pytest.mark.builds(by=needs), pytest.mark.deep]


@pytest.fixture
def drive(ros: Ros, programs: Sequence[Path], tmp_path: Path) -> Iterator[Ears]:
    """A drive on level ground that is to go at 0.4 m/s, and the node."""
    found = ros.ears(script="drive.py")
    node = ros.begin(programs[0], {"state_file": str(tmp_path / "latched")})
    try:
        until(lambda: found.last("/cmd_vel") == 0.4, "commands flow")
        yield found
    finally:
        node.end()
        found.end()


def test_a_slope_is_climbed_with_more_torque(drive: Ears) -> None:
    drive.set(pitch=15.0)
    until(lambda: drive.last("/drive/boost") is True, "more torque is asked for")
    assert drive.last(STATE)["active"] == ["rule_1"]
    until(lambda: drive.last("/cmd_vel") == 0.4, "commands still flow")
    drive.ask(forget="/drive/boost")
    until(lambda: drive.last("/drive/boost") is True, "it is asked for again and again")
    drive.set(pitch=0.0)
    until(lambda: drive.last(STATE)["active"] == [], "the slope is over")
    drive.silent("/drive/boost")


def test_a_ramp_is_left_backwards_and_then_commands_flow_again(drive: Ears) -> None:
    drive.set(pitch=25.0)
    drive.ask(forget="/cmd_vel")
    until(lambda: -0.1 in drive.heard("/cmd_vel"), "it moves back")
    begin = next(at for at, speed in drive.ask(heard="/cmd_vel") if speed == -0.1)
    until(lambda: any(at > begin for at in standing(drive)), "it moves no more")
    drive.set(pitch=0.0)
    until(lambda: drive.last("/cmd_vel") == 0.4, "commands flow again")
    until(lambda: drive.last(STATE)["active"] == [], "its state is reported")
    stood = next(at for at in standing(drive) if at > begin)
    after = [(at, speed) for at, speed in drive.ask(heard="/cmd_vel") if at >= begin]
    assert {speed for at, speed in after if at < stood} == {-0.1}, "nothing of the planner's"
    assert len([at for at, _ in after if at < stood]) > 1, "again, until it moves no more"
    behind = list(dropwhile(lambda speed: speed < 0.0, (speed for _, speed in after)))
    gentle = list(takewhile(lambda speed: speed > 0.0, behind))
    assert gentle[0] >= 0.2
    assert gentle == sorted(gentle)
    full = next(at for at, speed in after if speed == 0.4)
    assert full - stood > 0.6, "from 0.2 to 0.4 m/s, by 0.3 m/s^2"


def standing(drive: Ears) -> list[float]:
    """The instants at which it did not move forward. It does not stay so: commands flow again."""
    return [at for at, speed in drive.ask(heard="speed") if speed < 0.05]


def test_high_speed_is_limited_until_it_is_over(drive: Ears) -> None:
    drive.ask(forget="/cmd_vel")
    drive.set(wanted=0.8)
    until(lambda: drive.last("/cmd_vel") == 0.8, "0.8 m/s is commanded")
    until(lambda: drive.last("/cmd_vel") == 0.2, "at most 0.2 m/s passes")
    until(lambda: drive.last("/cmd_vel") > 0.2, "the limit is lifted")
    reported = drive.ask(heard="/cmd_vel")
    limited = next(at for at, speed in reported if speed == 0.2)
    lifted = next(at for at, speed in reported if at > limited and speed > 0.2)
    assert [speed for at, speed in drive.ask(heard="speed") if at < lifted][-1] <= 0.5
    drive.set(wanted=0.4)
    until(lambda: drive.last("/cmd_vel") == 0.4, "commands flow again")
