"""The common parts of all episodes of the arm."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from heron.experiments.arm_operator import ArmOperator
from heron.experiments.runner import SimulatedNode, run
from heron.guard import Guard, Occurrence
from heron.robot import Arm
from heron.tasks import SkillTask, TaskStatus


@dataclass
class ArmCell:
    """The arm, its task, and its operator."""

    arm: Arm
    task: SkillTask
    guard: Guard | None
    operator: ArmOperator | None
    nodes: list[SimulatedNode]

    def play(self, longest_s: float) -> None:
        """Until the task is over."""
        task = self.task
        until_ns = round(longest_s * 1e9)
        run(self.arm, self.nodes, until_ns, lambda: task.outcome is not TaskStatus.RUNNING)

    @property
    def visits(self) -> int:
        """The number of operator interventions."""
        return 0 if self.operator is None else self.operator.summons.visits

    @property
    def occurrences(self) -> Sequence[Occurrence]:
        """The deeds of the guard."""
        return () if self.guard is None else self.guard.occurrences
