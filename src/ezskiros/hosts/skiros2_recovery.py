"""Behavior trees that rules run in SkiROS2, instead of the tasks of its skill manager.

SkiROS2 ticks all its tasks one after the other (`BtTicker._tick`). While a tree runs, only the tree
is ticked. The primitives of the tasks have been preempted, and restart afterwards.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from queue import SimpleQueue
from typing import Any

from ezskiros.context.recovery_ros import serve
from ezskiros.context.ros import NoRosError
from ezskiros.engine.interruption import Afterwards, Recovery, newly_asked
from ezskiros.engine.recovery_goals import RecoveryGoals, RefusedGoalError
from ezskiros.engine.running import Running, with_values_of_now
from ezskiros.engine.world import World
from ezskiros.hosts.skiros2_api import api, ticker
from ezskiros.hosts.skiros2_context import HostedContext
from ezskiros.hosts.skiros2_values import give
from ezskiros.hosts.skiros2_world import HostedWorld
from ezskiros.ontology import Ontology
from ezskiros.skills.calls import SkillClass
from ezskiros.skills.interface import SkillInterface


@dataclass(frozen=True)
class HostedTree:
    """A skill that SkiROS2 can run as a tree. `implementations` are the names of its
    implementations.
    """

    description: SkillClass
    skill: SkillInterface
    ontology: Ontology
    implementations: tuple[str, ...]


class HostedRecoveries:
    """The tree that runs instead of the tasks, if there is one."""

    def __init__(self, trees: Iterable[HostedTree], context: HostedContext) -> None:
        self._trees: dict[str, HostedTree] = {}
        self.known: dict[str, tuple[SkillClass, SkillInterface]] = {}
        self.add(trees)
        self._context = context
        self._asked: SimpleQueue[Recovery] = SimpleQueue()
        self._recovery: Recovery | None = None
        self._root: Any = None
        self._visitor: Any = None
        self._interrupted: list[Running] | None = None

    def add(self, trees: Iterable[HostedTree]) -> None:
        """Add the trees of another library."""
        for each in trees:
            self._trees[each.skill.name] = each
            self.known[each.skill.name] = (each.description, each.skill)

    # --- for goals --------------------------------------------------------------------------------

    @property
    def world(self) -> World:
        """The world model of the tasks. Raises `RefusedGoalError` while there is no task."""
        visitor = ticker()._visitor  # noqa: SLF001 - SkiROS2 hands it to nobody
        if visitor is None or not ticker()._tasks:  # noqa: SLF001
            raise RefusedGoalError("no task runs")
        ontologies = [each.ontology for each in self._trees.values()]
        return HostedWorld(visitor._wm, ontologies[0])  # noqa: SLF001

    @property
    def running(self) -> Iterable[Running]:
        """The running skills of the tasks. While a tree runs instead, and until they run again,
        these are the skills that were running when the tree started.
        """
        return self._context.running if self._interrupted is None else self._interrupted

    def recover(self, recovery: Recovery) -> None:
        """Request a tree, from any thread. A running tree is replaced."""
        if recovery.afterwards is Afterwards.REPLAN:
            raise RefusedGoalError("SkiROS2 cannot replan: use `then retry`")
        self._asked.put(recovery)

    # --- for the ticker ---------------------------------------------------------------------------

    def install(self) -> None:
        """Make the ticker of SkiROS2 query this object at each tick."""
        kind = ticker()
        usual: Callable[[Any], None] = kind._tick  # noqa: SLF001

        def tick(ticking: Any) -> None:
            self.tick(ticking, usual)

        kind._tick = tick  # noqa: SLF001

    def tick(self, ticking: Any, usual: Callable[[Any], None]) -> None:
        """Tick the tree if there is one, otherwise all tasks."""
        self._take(ticking)
        if self._root is None or ticking._tasks_to_preempt:  # noqa: SLF001
            self._give_up("the task is stopped")
            usual(ticking)
            self._interrupted = None
            return
        self._context.keep()
        state = self._visitor.traverse(self._root)
        if state not in (api().State.Running, api().State.Idle):
            self._end(ticking, usual, is_success=state == api().State.Success)

    def _take(self, ticking: Any) -> None:
        """Start the last tree that was requested since the tick before."""
        if self._recovery is not None and self._recovery.is_released:
            self._give_up("it was stopped")
        for asked in newly_asked(self._asked):
            self._give_up("another tree was requested")
            self._begin(asked, ticking)

    def _begin(self, asked: Recovery, ticking: Any) -> None:
        tasks = ticking._visitor  # noqa: SLF001
        try:
            visitor = api().VisitorExecutor(tasks._wm, tasks._instanciator)  # noqa: SLF001
            visitor.setVerbose(tasks._verbose)  # noqa: SLF001
            root = self._tree(asked, tasks)
            interrupted = with_values_of_now(self.running)
        except Exception as problem:  # SkiROS2's exception for a missing skill
            asked.done(False, f"SkiROS2 cannot run it: {problem}")
            return
        self._interrupted = interrupted
        for task in ticking._tasks.values():  # noqa: SLF001
            for leaf in list(_running_primitives(task)):
                leaf.visitPreempt(tasks)
        self._recovery, self._root, self._visitor = asked, root, visitor

    def _tree(self, asked: Recovery, tasks: Any) -> Any:
        """A SkiROS2 root with the skill, like the root that its skill manager makes for a task."""
        found = self._trees[asked.call.skill.__name__]
        instanciator = tasks._instanciator  # noqa: SLF001
        name = f"skiros:{found.skill.name}"
        if not instanciator.get_instances(name):
            for each in found.implementations:
                instanciator.add_instance(each)
        world = HostedWorld(tasks._wm, found.ontology)  # noqa: SLF001
        node = api().SkillWrapper(name, "", instanciator)
        params = api().ParamHandler()
        params.reset(node.params.getCopy())
        for parameter in found.skill.parameters:
            if parameter.name in asked.call.arguments:
                give(parameter, asked.call.arguments[parameter.name], params, world)
        root = api().Root("recovery", tasks._wm)  # noqa: SLF001
        root.addChild(node)
        node.specifyParamsDefault(params)
        return root

    def _give_up(self, why: str) -> None:
        """End the tree, if one runs."""
        root, recovery = self._root, self._recovery
        self._root = self._recovery = None
        if root is not None and recovery is not None:
            root.visitPreempt(self._visitor)
            recovery.done(False, why)

    def _end(self, ticking: Any, usual: Callable[[Any], None], *, is_success: bool) -> None:
        """After the tree, continue the tasks, or let them fail."""
        recovery = self._recovery
        assert recovery is not None, "a tree runs"
        self._root = self._recovery = None
        tasks = ticking._tasks  # noqa: SLF001
        if not is_success:
            ticking._tasks_to_preempt.extend(tasks)  # noqa: SLF001
            usual(ticking)
            self._interrupted = None
            recovery.done(False, "the recovery has failed")
            return
        if recovery.afterwards is Afterwards.RETRY:
            for task in tasks.values():
                task.visitPreempt(ticking._visitor)  # noqa: SLF001
        recovery.done(True, "")


_recoveries: list[HostedRecoveries] = []
"""The recoveries of this process, if a library names an export."""


def begin(
    trees: Iterable[HostedTree],
    context: HostedContext,
    serving: Callable[[RecoveryGoals], object] = serve,
) -> str | None:
    """Let rules run these skills as trees. Returns None on success, otherwise the reason."""
    if _recoveries:
        _recoveries[0].add(trees)
        return None
    found = HostedRecoveries(trees, context)
    try:
        serving(RecoveryGoals(context.digest, found))
    except NoRosError as problem:
        return str(problem)
    found.install()
    _recoveries.append(found)
    return None


def _running_primitives(node: Any) -> Iterator[Any]:
    """The running primitives below a SkiROS2 node, or the node itself."""
    if not node.hasState(api().State.Running):
        return
    if not node.hasChildren():
        yield node
        return
    for each in node._children:  # noqa: SLF001
        yield from _running_primitives(each)
