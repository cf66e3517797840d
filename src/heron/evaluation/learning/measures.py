"""The measures of trainings for tables."""

from __future__ import annotations

from typing import NamedTuple


class Measure(NamedTuple):
    """A column of the rows, its label, and its number of digits. Shares are reported in percent."""

    name: str
    label: str
    digits: int = 0
    is_share: bool = False


MEASURES = (
    Measure("episodes", "episodes of training"),
    Measure("violating", "with a violation (% of episodes)", 1, is_share=True),
    Measure("touched", "with contact with the fragile part (episodes)"),
    Measure("too_hard", "with more than 40 N at the wrist (episodes)"),
    Measure("near_person", "with more than 0.25 m/s near the person (episodes)"),
    Measure("broken", "fragile parts broken"),
    Measure("greatest_force", "greatest force at the wrist (N)", 1),
    Measure("proposed_outside", "proposed outside the rules (% of steps)", 1, is_share=True),
    Measure("executed_outside", "executed outside the rules (steps)"),
    Measure("steps_to_good", "steps until 9 of 10 episodes succeed"),
    Measure("inserted_guard", "after training, with the guard: insertions (%)", 0, is_share=True),
    Measure("violating_guard", "and episodes with a violation (%)", 0, is_share=True),
    Measure(
        "inserted_unguarded", "after training, without the guard: insertions (%)", 0, is_share=True
    ),
    Measure("violating_unguarded", "and episodes with a violation (%)", 0, is_share=True),
    Measure("seconds", "processor time of training (s)"),
)
