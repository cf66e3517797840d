"""Random reactions, and random events for them.

    @given(reacting_cases())
    def test_something(case: ReactingCase) -> None: ...

Timeouts, periods and instants are small multiples of one tick, so that much falls together; there
are few resources, so that rules often want the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.interpreter import Reactor, TaskState
from rossmarie.ir import TruthValue, reactions
from support.drafts import NOWHERE
from support.growing import TICK
from support.machines import instants
from support.plans import command, reacting

# What waits for its resource comes more often: there is most to happen to it.
KINDS = (
    "repeat", "set", "cancel", "repeat", "switch", "send", "call", "publish", "diagnose", "log",
)  # fmt: skip
RETRACING = ("retrace", "retrace", "retrace")
COMMANDING = ("limit", "limit", "scale")

timeouts = st.sampled_from((1, 2, 4, 9, 40)).map(lambda ticks: ticks * TICK)
ramps = st.sampled_from((None, None, 0.1, 0.5, 1 / 3, 5e-324, 1e308))
lows = st.sampled_from((0.0, -0.0, -0.1, -0.5, -1 / 3, -2.0, -1.7e308))
READINGS = 7
memories = st.builds(
    lambda pose, *rest: reactions.Memory(tuple(range(pose)), *rest),
    st.sampled_from(reactions.POSES),
    st.sampled_from((1, 2, 3, 5)),
    st.sampled_from((0.5, 1.0, 1e-300)),
    st.sampled_from((0, TICK, 3 * TICK)),
)
factors = st.sampled_from((0.0, 0.1, 0.5, 1 / 3, 1.0))


# --- reactions -------------------------------------------------------------------------------


class Sprouting:
    """Adds one random rule at a time to reactions in the making."""

    def __init__(
        self, draw: st.DrawFn, watches: int | None = None, *, retraces: bool = True
    ) -> None:
        self.draw = draw
        self.fields = draw(st.lists(st.integers(1, 3), max_size=2))
        self.watches = draw(st.integers(0, 2)) if watches is None else watches
        self.memories = draw(st.lists(memories, max_size=2)) if retraces else []
        self.tasks: list[reactions.Task | None] = []
        self.plans: list[reactions.RecoveryPlan] = []

    def rule(self) -> None:
        first = len(self.tasks)
        stages = [self._tasks(3, depth=2) for _ in range(self.draw(st.sampled_from((1, 2, 3, 0))))]
        tasks = tuple(range(first, len(self.tasks)))
        others = range(len(self.plans))  # earlier rules only: then there is no circle
        unless = self.draw(st.lists(st.sampled_from(others), max_size=2)) if others else []
        self.plans.append(reactions.RecoveryPlan(tuple(stages), tasks, tuple(unless)))

    def made(self) -> ir.Reactions:
        """All that has grown so far."""
        used = [each.effect for each in self.tasks if each is not None]
        kept = sorted({each.memory for each in used if isinstance(each, reactions.Retrace)})
        return ir.Reactions(
            commands=tuple(command(count, n) for n, count in enumerate(self.fields)),
            actions=(reactions.Action("act", None, NOWHERE),),
            resources=tuple(f"resource {number}" for number in range(2)),
            tasks=tuple(_renumbered(task, kept) for task in self.tasks if task is not None),
            plans=tuple(self.plans),
            order=tuple(self.draw(st.permutations(range(len(self.plans))))),
            memories=tuple(self.memories[memory] for memory in kept),
        )

    def _tasks(self, most: int, depth: int) -> tuple[int, ...]:
        return tuple(
            self._task(depth) for _ in range(self.draw(st.sampled_from((*range(1, most + 1), 0))))
        )

    def _task(self, depth: int) -> int:
        index = len(self.tasks)
        self.tasks.append(None)  # what follows from its failure stands behind it
        effect = self._effect()
        needs = reactions.target_of(effect) is not None
        resource = self.draw(st.sampled_from((0, 0, 1))) if needs else None
        otherwise = self._tasks(2, depth - 1) if depth and self.draw(st.booleans()) else ()
        if resource is not None:
            effect = _on(effect, resource)
        self.tasks[index] = reactions.Task(0, effect, resource, otherwise, NOWHERE)
        return index

    def _effect(self) -> reactions.Effect:
        draw, timeout_ns = self.draw, self.draw(timeouts)
        interrupted = draw(st.sampled_from(reactions.Interrupted))
        kinds = KINDS + (COMMANDING if self.fields else ())
        match draw(st.sampled_from(kinds + (RETRACING if self.memories else ()))):
            case "limit":
                return self._limit()
            case "scale":
                topic = draw(st.integers(0, len(self.fields) - 1))
                return reactions.Scale(topic, draw(factors), draw(ramps))
            case "publish":
                return reactions.Publish("/topic", "std_msgs/Bool", (), None, None)
            case "repeat":
                return reactions.Publish("/topic", "std_msgs/Bool", (), timeout_ns, None)
            case "retrace":
                memory = draw(st.integers(0, len(self.memories) - 1))
                numbers = tuple((f"n{n}",) for n in self.memories[memory].readings)
                kind = "geometry_msgs/Pose"
                return reactions.Retrace("/pose", kind, (), numbers, timeout_ns, memory)
            case "call":
                return reactions.Call("/call", "std_srvs/Trigger", (), timeout_ns)
            case "set":
                return reactions.SetParameter("/node", "parameter", True, timeout_ns)
            case "switch":
                return reactions.SwitchControllers("/manager", ("a",), ("b",), timeout_ns)
            case "send":
                return reactions.SendGoal("/server", "a_msgs/A", (), timeout_ns, interrupted)
            case "cancel":
                watch = st.sampled_from((None, *range(self.watches)))
                return reactions.CancelGoal("/server", None, draw(watch), timeout_ns, interrupted)
            case "log":
                return reactions.Log(reactions.Level.DEBUG, "text")
            case _:
                return reactions.Diagnose(reactions.Level.ERROR, "text")

    def _limit(self) -> reactions.Limit:
        topic = self.draw(st.integers(0, len(self.fields) - 1))
        fields = st.integers(0, self.fields[topic] - 1)
        bounds = st.builds(
            reactions.Bound, fields, lows, lows.map(lambda low: -low), ramps
        )  # fmt: skip
        return reactions.Limit(topic, tuple(self.draw(st.lists(bounds, max_size=3))))


def _on(effect: reactions.Effect, resource: int) -> reactions.Effect:
    """The same effect on something that is this resource: nothing is two resources."""
    match effect:
        case reactions.SetParameter(node=node):
            return replace(effect, node=f"{node}_{resource}")
        case reactions.SwitchControllers(manager=manager):
            return replace(effect, manager=f"{manager}_{resource}")
        case reactions.SendGoal(server=server) | reactions.CancelGoal(server=server):
            return replace(effect, server=f"{server}_{resource}")
        case reactions.Call(service=service):
            return replace(effect, service=f"{service}_{resource}")
        case reactions.Publish(topic=topic) | reactions.Retrace(topic=topic):
            return replace(effect, topic=f"{topic}_{resource}")
        case (
            reactions.Limit() | reactions.Scale() | reactions.Log() | reactions.Diagnose()
            | reactions.Hook() | reactions.Reset()
        ):  # fmt: skip
            return effect


@st.composite
def reacting_machines(draw: st.DrawFn) -> ir.Machine:
    """A machine with at least one task, whose rules and watches rest on a flag each."""
    sprouting = Sprouting(draw)
    for _ in range(draw(st.sampled_from((1, 2, 3, 3, 4)))):
        sprouting.rule()
    if not sprouting.tasks:
        sprouting.plans.append(reactions.RecoveryPlan(((0,),), (0,)))
        sprouting.tasks.append(reactions.Task(0, reactions.Hook("hook"), None, (), NOWHERE))
    return reacting(sprouting.made(), sprouting.watches)


def _renumbered(task: reactions.Task, kept: Sequence[int]) -> reactions.Task:
    """The memories that nothing retraces are left out."""
    if not isinstance(task.effect, reactions.Retrace):
        return task
    return replace(task, effect=replace(task.effect, memory=kept.index(task.effect.memory)))


# --- events ----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Look:
    """The reactor is told which rules are engaged or, if `report` is not None, that a task ended
    (and whether well).
    """

    at_ns: int
    engaged: tuple[bool, ...]
    watches: tuple[TruthValue, ...]
    report: tuple[int, bool] | None
    readings: tuple[float, ...] = ()


@dataclass(frozen=True)
class ReactingCase:
    """A machine and what happens to its reactor, which opens before one of the events, or never."""

    machine: ir.Machine
    events: list[Look]
    opens_before: int


@st.composite
def reacting_cases(
    draw: st.DrawFn, max_events: int = 24, has_ends_of_time: bool = False
) -> ReactingCase:
    """Random reactions and random events: equal instants, jumps back, ends that nobody awaits and,
    if asked for, jumps from end to end of time. A reactor runs along, so that most of the tasks
    that are said to have ended were running.
    """
    machine = draw(reacting_machines())
    reactor = Reactor(machine.reactions)
    events: list[Look] = []
    engaged = [False] * len(machine.rules)
    times = draw(instants(max_events, least=max_events // 3))
    if has_ends_of_time and draw(st.booleans()):
        place = draw(st.integers(0, len(times)))
        times[place:place] = [ir.LATEST_NS - 1, ir.EARLIEST_NS + 1] * draw(st.integers(1, 2))
    for at_ns in times:
        watches = tuple(draw(st.sampled_from(TruthValue)) for _ in machine.watches)
        report = None
        if draw(st.integers(0, 2)) == 0:
            report = draw(_reports(reactor))
        else:
            rule = draw(st.integers(0, len(engaged) - 1))
            engaged[rule] = not engaged[rule]
        poses = [draw(st.sampled_from(_NUMBERS)) for _ in machine.readings]
        if poses and draw(st.integers(0, 5)) == 0:
            poses[draw(st.integers(0, len(poses) - 1))] = float("nan")
        events.append(Look(at_ns, tuple(engaged), watches, report, tuple(poses)))
        look(reactor, events[-1])
    return ReactingCase(machine, events, draw(st.sampled_from((0, 0, 0, 3, max_events))))


def _reports(reactor: Reactor) -> st.SearchStrategy[tuple[int, bool]]:
    tasks = range(len(reactor.states))
    running = [task for task in tasks if reactor.states[task] is TaskState.RUNNING]
    which = st.sampled_from(running) if running else st.sampled_from(tasks)
    return st.tuples(st.one_of(which, which, st.sampled_from(tasks)), st.sampled_from(_SUCCESSES))


_NUMBERS = (0.0, 0.0, 0.5, 1.0, -1.0, 1 / 3, 1e200, -0.0)
_SUCCESSES = (True, True, False)


def look(reactor: Reactor, event: Look) -> Sequence[ir.TaskCommand]:
    """Let an event happen."""
    if event.report is None:
        return reactor.react(event.at_ns, event.engaged, event.watches, event.readings)
    task, success = event.report
    return reactor.report(event.at_ns, task, success, event.watches)
