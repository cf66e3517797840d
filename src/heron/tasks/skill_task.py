"""A task: a skill of EzSkiROS, checked before it runs, and ticked as often as in SkiROS2."""

from __future__ import annotations

from collections.abc import Iterable

from py_trees.common import Status

from ezskiros.engine.ahead import Ahead, skills_ahead
from ezskiros.engine.events import Event
from ezskiros.engine.expansion import Expansions
from ezskiros.engine.running import RunningSkills
from ezskiros.engine.setting import Setting
from ezskiros.engine.task import Task
from ezskiros.runner import prepare
from heron.skills import FOLDER
from heron.skills.servers import CARRIER
from heron.tasks.outcome import Outcome
from heron.tasks.tree import TreeSkill, tree_over_time
from heron.topics import Carrier

_OUTCOMES = {Status.SUCCESS: Outcome.COMPLETED, Status.FAILURE: Outcome.GIVEN_UP}


class SkillTask:
    """Begins after a second, when sensors have settled."""

    period_ns = 40_000_000
    _BEGIN_NS = 1_000_000_000

    def __init__(self, carrier: Carrier, skill: str, scene: str, arguments: Iterable[str]) -> None:
        """Raises `FaultyError` if the skills or the scene have errors."""
        ready = prepare(skill, [FOLDER], FOLDER / scene, ["Robot=heron", *arguments])
        self._carrier = carrier
        self.now_ns = self._offset_ns = 0
        """The time of the episode, at the last tick."""
        self._task = Task(
            ready.call,
            Setting(
                ready.library,
                ready.world,
                tell=lambda event: self._events.append((self.now_ns * 1e-9, event)),
                clock=lambda: self.now_ns * 1e-9,
                expansions=Expansions(ready.trees),
            ),
        )
        self._events: list[tuple[float, Event]] = []
        self.outcome = Outcome.RUNNING

    @property
    def running(self) -> RunningSkills:
        """The skills that run now."""
        return self._task.setting.running

    @property
    def ahead(self) -> list[Ahead]:
        """The skills that can start next."""
        return skills_ahead(self._task.root)

    @property
    def tree(self) -> tuple[TreeSkill, ...]:
        """The skills of the task, and what has become of them."""
        return tree_over_time(self._task.root, self._events)

    def go_on(self, carrier: Carrier, began_ns: int) -> None:
        """In another scene, which has a carrier and a time of its own."""
        self._carrier = carrier
        self._offset_ns = began_ns

    def tick(self, now_ns: int) -> None:
        """One period later."""
        self.now_ns = now_ns + self._offset_ns
        if self.now_ns < self._BEGIN_NS or self.outcome is not Outcome.RUNNING:
            return
        token = CARRIER.set(self._carrier)
        try:
            self.outcome = _OUTCOMES.get(self._task.tick(), Outcome.RUNNING)
        finally:
            CARRIER.reset(token)
