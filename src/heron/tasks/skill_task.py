"""A task: an EzSkiROS skill that is checked before it runs, and ticked at the rate of SkiROS2."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from concurrent.futures import Future

from py_trees.common import Status

from ezskiros.engine.ahead import Ahead
from ezskiros.engine.events import Event
from ezskiros.engine.execution_context import ExecutionContext
from ezskiros.engine.expansion import Expansions
from ezskiros.engine.interruption import InterruptibleTask, NoPlanError, PlannedCalls
from ezskiros.engine.prohibitions import Prohibition
from ezskiros.engine.running import RunningSkills
from ezskiros.engine.skill import SkillChild
from ezskiros.learning.lessons import Cost
from ezskiros.planning.replanning import planned_calls
from ezskiros.runner import prepare
from ezskiros.skills.calls import SkillCall
from heron.goals import RECOVERY
from heron.skills import FOLDER
from heron.skills.exported import digest
from heron.skills.servers import CARRIER
from heron.tasks.outcome import TaskStatus
from heron.tasks.recovery import RecoveryServer
from heron.tasks.tree import Begun, TreeSkill, tree_over_time
from heron.topics import Carrier

_OUTCOMES = {Status.SUCCESS: TaskStatus.COMPLETED, Status.FAILURE: TaskStatus.GIVEN_UP}
_LONGEST_SEARCH_S = 60.0
"""Time stands still meanwhile: a busy computer may take this long."""


class SkillTask:
    """Begins after a second, when sensors have settled. Rules may ask it for recovery trees."""

    period_ns = 40_000_000
    _BEGIN_NS = 1_000_000_000

    def __init__(
        self,
        carrier: Carrier,
        skill: str,
        scene: str,
        arguments: Iterable[str],
        costs: Sequence[Cost] | None = None,
    ) -> None:
        """With `costs` of skills, of which there may be none, a plan leads to the post-conditions
        of the skill; without, its own tree. Raises `FaultyError` if the skills or the scene have
        errors, `NoPlanError` if there is no plan, and `ValueError` if the export of the skills is
        none.
        """
        ready = prepare(skill, [FOLDER], FOLDER / scene, ["Robot=heron", *arguments])
        self._carrier = carrier
        self.now_ns = self._offset_ns = 0
        """The time of the episode, at the last tick."""
        execution = ExecutionContext(
            ready.library,
            ready.world,
            tell=lambda event: self._events.append((self.now_ns * 1e-9, event)),
            clock=lambda: self.now_ns * 1e-9,
            expansions=Expansions(ready.trees),
        )
        self._costs = costs or ()
        self._task = InterruptibleTask(ready.call, execution, self._replanned)
        if costs is not None:
            self._task.go_by(self._planned(ready.call))
        self._events: list[tuple[float, Event]] = []
        self._trees = [Begun(self._task.root, 0)]
        self._task.begun = self._note
        self.replanned = 0
        """The number of reroutes."""
        self.outcome = TaskStatus.RUNNING
        self._recovery = RecoveryServer(digest(), self._task)
        carrier.serve(RECOVERY, self._recovery)

    @property
    def running(self) -> RunningSkills:
        """The skills that run now."""
        return self._task.execution.running

    @property
    def ahead(self) -> list[Ahead] | None:
        """The skills that can start next; None if they are not known."""
        return self._task.ahead

    @property
    def tree(self) -> tuple[TreeSkill, ...]:
        """The skills of the task, with their states over time."""
        return tree_over_time(self._trees, self._events)

    @property
    def events(self) -> Sequence[tuple[float, Event]]:
        """The events of its skills, with their instants (s)."""
        return self._events

    def go_on(self, carrier: Carrier, began_ns: int) -> None:
        """Continue in another scene, with its own carrier and time."""
        self._carrier = carrier
        carrier.serve(RECOVERY, self._recovery)
        self._offset_ns = began_ns

    def tick(self, now_ns: int) -> None:
        """One period later."""
        self.now_ns = now_ns + self._offset_ns
        if self.now_ns < self._BEGIN_NS or self.outcome is not TaskStatus.RUNNING:
            return
        token = CARRIER.set(self._carrier)
        try:
            self.outcome = _OUTCOMES.get(self._task.tick(), TaskStatus.RUNNING)
        finally:
            CARRIER.reset(token)

    def _note(self, root: SkillChild) -> None:
        self._trees.append(Begun(root, len(self._events)))

    def _replanned(self, call: SkillCall, without: Sequence[Prohibition]) -> Future[PlannedCalls]:
        """Find another path to the goal immediately, while time stands still. In a thread, the
        episode would depend on the load of the computer.
        """
        found: Future[PlannedCalls] = Future()
        try:
            found.set_result(self._planned(call, without))
        except NoPlanError as problem:
            found.set_exception(problem)
        else:
            self.replanned += 1
        return found

    def _planned(self, call: SkillCall, without: Sequence[Prohibition] = ()) -> PlannedCalls:
        """The skills that lead to the goal from where the world is now. Raises `NoPlanError`."""
        execution = self._task.execution
        start = execution.world.copy()
        return planned_calls(
            execution.library,
            call,
            execution.world,
            start,
            without,
            costs=self._costs,
            seconds=_LONGEST_SEARCH_S,
        )
