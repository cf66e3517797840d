"""The measures of trainings for tables."""

from __future__ import annotations

from typing import NamedTuple


class MeasureColumn(NamedTuple):
    """A column of the rows, its label, and its number of digits. Shares are reported in percent."""

    name: str
    label: str
    digits: int = 0
    is_share: bool = False


MEASURES = (
    MeasureColumn("episodes", "episodes of training"),
    MeasureColumn("violating", "with a violation (% of episodes)", 1, is_share=True),
    MeasureColumn("touched", "with contact with the fragile part (episodes)"),
    MeasureColumn("too_hard", "with more than 40 N at the wrist (episodes)"),
    MeasureColumn("near_person", "with more than 0.25 m/s near the person (episodes)"),
    MeasureColumn("broken", "fragile parts broken"),
    MeasureColumn("greatest_force", "greatest force at the wrist (N)", 1),
    MeasureColumn("proposed_outside", "proposed outside the rules (% of steps)", 1, is_share=True),
    MeasureColumn("executed_outside", "executed outside the rules (steps)"),
    MeasureColumn("steps_to_good", "steps until 9 of 10 episodes succeed"),
    MeasureColumn(
        "inserted_guard", "after training, with the guard: insertions (%)", 0, is_share=True
    ),
    MeasureColumn("violating_guard", "and episodes with a violation (%)", 0, is_share=True),
    MeasureColumn(
        "inserted_unguarded", "after training, without the guard: insertions (%)", 0, is_share=True
    ),
    MeasureColumn("violating_unguarded", "and episodes with a violation (%)", 0, is_share=True),
    MeasureColumn("seconds", "processor time of training (s)"),
)
