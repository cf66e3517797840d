"""The action server of a task, to which rules send behavior trees: `/recovery`."""

from __future__ import annotations

from collections.abc import Callable

from ezskiros.engine.interruption import InterruptibleTask, Recovery
from ezskiros.engine.recovery_goals import RecoveryGoals, RefusedGoalError, TaskHost
from heron.goals import Goal, Value


class RecoveryServer:
    """Hands goals to a task. Its goals have the fields of `skill_context_msgs/Recover`."""

    def __init__(self, digest: str, task: InterruptibleTask) -> None:
        """`digest` is the digest of the export with which the rules must be checked."""
        self._goals = RecoveryGoals(digest, TaskHost(task))
        self._recovery: Recovery | None = None

    def send(self, goal: Goal, done: Callable[[bool], None]) -> None:
        """Run a tree at the next tick; one that is refused has not succeeded."""
        try:
            self._recovery = self._goals.begin(
                str(goal["digest"]),
                str(goal["skill"]),
                _texts(goal["arguments"]),
                str(goal["afterwards"]),
                _texts(goal.get("without", ())),
                lambda is_success, _: done(is_success),
            )
        except RefusedGoalError:
            done(False)

    def cancel(self) -> None:
        """The rule was cleared: the tree stops, and the task continues."""
        if self._recovery is not None:
            self._recovery.release()


def _texts(value: Value) -> list[str]:
    return [str(each) for each in (value if isinstance(value, tuple) else (value,))]
