"""A part of a real drive gives the same verdicts in `rossmarie replay` and, played, in the node."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from rossmarie.driver import compile_file
from support.live import Wanted
from support.live_replay import replayed, says
from support.parts import A_DRIVE, needs
from support.ros1_live import Ros1
from support.shared import HUSKY_DRIVE

HUSKY = Path(__file__).parents[3] / "examples" / "husky" / "husky.ross"

NEAR = 0.03
"""Seconds by which instants may differ: time is reported in steps."""

START, SECONDS = 177.0, 37.0


def needs_of_husky(_generation: str) -> Sequence[Wanted]:
    """The node of the rules."""
    return [compile_file(HUSKY).machine]


@pytest.mark.deep
@needs(A_DRIVE)
@pytest.mark.builds(by=needs_of_husky)
def test_a_part_of_a_real_drive_gives_the_same_verdicts(
    ros1: Ros1, programs: Sequence[Path], tmp_path: Path
) -> None:
    expected = replayed(HUSKY, HUSKY_DRIVE, NEAR, (START, START + SECONDS))
    assert {rule for rule, _, _ in expected} == {"limit_speed", "slow_on_jolts", "slow_on_slopes"}
    reported = says(
        ros1,
        programs[0],
        tmp_path / "latched",
        lambda: ros1.play(HUSKY_DRIVE, START, SECONDS),
        len(expected),
    )
    assert reported == expected
