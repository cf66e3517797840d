"""A running skill with the same values as in SkiROS2, for `--compatible`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from py_trees.common import Status

from ezskiros.engine.blackboard import Blackboard, Cells, Remaps, remaps_of
from ezskiros.engine.events import Reason
from ezskiros.engine.plans import ChildStart
from ezskiros.engine.skill import SkillChild


class CompatibleSkill(SkillChild):
    """A child with the values of a blackboard, which all skills of a task share.

    The child reads the blackboard when it starts, before each tick of a primitive, when the tree of
    a compound has a result, and before a stop. It writes when it runs, and after each of these.
    """

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        above = self.above if isinstance(self.above, CompatibleSkill) else None
        self.blackboard: Blackboard = above.blackboard if above else Blackboard()
        self.remaps: Remaps | None = None
        self._remaps_above = above.remaps if above else None
        self._cells: Cells | None = None

    def update(self) -> Status:
        """Tick once. The children of a compound are ticked first."""
        self._values.update(self._known.values() if self._tree is not None else self._known.read())
        status = super().update()
        if status is Status.RUNNING and self._tree is None:
            self._share()
        return status

    @property
    def _known(self) -> Cells:
        assert self._cells is not None, "a skill has cells once it has started"
        return self._cells

    def _plans(self) -> Sequence[ChildStart]:
        """The first implementation only, because SkiROS2 tries no other one."""
        return super()._plans()[:1]

    def _started_with(self, plan: ChildStart) -> dict[str, Any]:
        if self._cells is None:
            self.remaps = remaps_of(self._call, plan, self._remaps_above)
            world = self._execution.world
            self._cells = Cells(plan, self.remaps.by_own(), self.blackboard, world)
        return self._cells.start()

    def _start(self) -> Reason | None:
        problem = super()._start()
        if problem is None:
            self._known.share()
        return problem

    def _begin(self) -> Reason | None:
        problem = super()._begin()
        self._known.fill(self._values)
        return problem

    def _expand(self) -> Reason | None:
        """Use the tree of the first start, also for other values."""
        if self._tree is not None:
            return None
        problem = super()._expand()
        if problem is None:
            self._tree_names.values = {}  # children take their values from the blackboard
        return problem

    def _share(self) -> None:
        if self.status is not Status.RUNNING:  # inferred values are shared when the skill runs
            self._known.replace(self._values)
            return
        self._known.fill(self._values)
        self._known.share()

    def _succeed(self, code: int, text: str) -> Status:
        self._read_after_tree()
        return super()._succeed(code, text)

    def _end(self, problem: Reason) -> Status:
        self._read_after_tree()
        return super()._end(problem)

    def _read_after_tree(self) -> None:
        if self._tree is not None:
            self._values.update(self._known.read())

    def _preempted(self) -> Reason | None:
        self._values.update(self._known.read())
        if self._tree is not None:
            self._tree.stop(Status.INVALID)
            self._values.update(self._known.values())
        problem = super()._preempted()
        self._share()
        return problem
