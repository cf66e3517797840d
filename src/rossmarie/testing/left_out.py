"""Conditions on points that generated tests leave out, described in words."""

from __future__ import annotations

from collections.abc import Iterator, Set

from rossmarie import ir
from rossmarie.ir.support import supports
from rossmarie.testing.goals import Aspect, TraceGoal, goals


def points_left_out(machine: ir.Machine, reached: Set[TraceGoal]) -> Iterator[str]:
    """The values that no generated test gives to a condition on points of a scan, with the
    reason.
    """
    rests_on = supports(machine).propositions
    missing: dict[tuple[int, int], list[str]] = {}
    for goal in goals(machine):
        if goal.aspect in (Aspect.TRUE, Aspect.FALSE) and goal not in reached:
            missing.setdefault((goal.rule, goal.subject), []).append(goal.aspect.value)
    for (rule, proposition), aspects in missing.items():
        used = _scan_of(machine, rests_on[proposition].inputs)
        if used is None:
            continue
        text = " ".join(machine.propositions[proposition].text.split())
        yield (
            f"{machine.rules[rule].name}: no test makes `{text}` {' or '.join(aspects)}: points "
            f"were tried straight ahead of the scanner, to its left, to its right and behind it; "
            f"set other beams by hand: `{used}.ranges[A .. B] = ...`"
        )


def _scan_of(machine: ir.Machine, inputs: Set[int]) -> str | None:
    """The first of these inputs that provides points of a scan; None if there is none."""
    of_points = (each.input for each in machine.arrays if ir.RETURNS in each.path)
    return next((machine.inputs[used].name for used in of_points if used in inputs), None)
