"""Reactions written down by hand: a draft grows task by task, and a bench drives its reactor.

Times are in seconds, and task commands are reported in words: `start 0`, `stop 1`, `overruled 2 by
0`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from rossmarie import ir
from rossmarie.interpreter import Reactor, TaskState
from rossmarie.ir import TruthValue, reactions, verify
from support.bench import ns
from support.drafts import NOWHERE, SECOND, Draft

Stage = Sequence[int]


# --- effects ---------------------------------------------------------------------------------


def limit(low: float, high: float, ramp: float | None = None, number: int = 0) -> reactions.Limit:
    """A limit of one field of the first command."""
    return reactions.Limit(0, (reactions.Bound(number, low, high, ramp),))


def scale(factor: float, ramp: float | None = None) -> reactions.Scale:
    """The first command, scaled."""
    return reactions.Scale(0, factor, ramp)


def publish(period_ns: int | None = None, number: float = 0) -> reactions.Publish:
    """A number, once or at a rate."""
    message = (reactions.Assignment(("data",), number),)
    return reactions.Publish("/light", "std_msgs/Float64", message, period_ns, None)


def retrace(period_ns: int = SECOND, topic: str = "/target", memory: int = 0) -> reactions.Retrace:
    """Positions on a topic."""
    numbers = (("x",), ("y",), ("z",))
    return reactions.Retrace(topic, "geometry_msgs/Point", (), numbers, period_ns, memory)


def call(timeout_ns: int = 2 * SECOND) -> reactions.Call:
    """A service."""
    return reactions.Call("/call", "std_srvs/Trigger", (), timeout_ns)


def set_parameter(timeout_ns: int = 2 * SECOND) -> reactions.SetParameter:
    """A parameter."""
    return reactions.SetParameter("/planner", "speed", 0.1, timeout_ns)


def switch(timeout_ns: int = 2 * SECOND) -> reactions.SwitchControllers:
    """A controller manager."""
    return reactions.SwitchControllers("/manager", ("slow",), ("fast",), timeout_ns)


def send(
    interrupted: reactions.Interrupted = reactions.Interrupted.DROP, timeout_ns: int = 2 * SECOND
) -> reactions.SendGoal:
    """A goal."""
    return reactions.SendGoal("/move", "move_base_msgs/MoveBase", (), timeout_ns, interrupted)


def cancel(
    confirmation: int | None = None,
    timeout_ns: int = 2 * SECOND,
    interrupted: reactions.Interrupted = reactions.Interrupted.DROP,
) -> reactions.CancelGoal:
    """All goals of a server."""
    return reactions.CancelGoal("/move", None, confirmation, timeout_ns, interrupted)


def log() -> reactions.Log:
    """A line in the log: something that is done at once."""
    return reactions.Log(reactions.Level.INFORMATION, "here")


def diagnose() -> reactions.Diagnose:
    """A status: something that is in force at once, and needs nothing for itself."""
    return reactions.Diagnose(reactions.Level.WARNING, "here")


# --- drafts ----------------------------------------------------------------------------------


@dataclass
class Plans:
    """Reactions in the making. The first command has as many fields as are asked for."""

    fields: int = 1
    tasks: list[reactions.Task] = field(default_factory=list)
    plans: list[reactions.RecoveryPlan] = field(default_factory=list)

    def task(
        self, effect: reactions.Effect, *, otherwise: Sequence[int] = (), resource: int = 0
    ) -> int:
        """A task; what needs something for itself needs the first resource if nothing is said."""
        needed = resource if reactions.target_of(effect) is not None else None
        self.tasks.append(reactions.Task(0, effect, needed, tuple(otherwise), NOWHERE))
        return len(self.tasks) - 1

    def rule(self, *stages: Stage, unless: Sequence[int] = ()) -> int:
        """A rule with these stages; escalations come along."""
        tasks = [task for stage in stages for task in stage]
        for task in tasks:
            tasks.extend(self.tasks[task].otherwise)
        plan = reactions.RecoveryPlan(
            tuple(map(tuple, stages)), tuple(sorted(tasks)), tuple(unless)
        )
        self.plans.append(plan)
        return len(self.plans) - 1

    def machine(
        self,
        order: Sequence[int] | None = None,
        watches: int = 0,
        memories: Sequence[reactions.Memory] = (),
    ) -> ir.Machine:
        """A machine with these reactions: each rule and each watch rests on a flag of its own."""
        first = tuple(range(len(self.plans)))
        found = ir.Reactions(
            commands=(command(self.fields),),
            actions=(reactions.Action("act", None, NOWHERE),),
            resources=("first", "second", "third"),
            tasks=tuple(self.tasks),
            plans=tuple(self.plans),
            order=first if order is None else tuple(order),
            memories=tuple(memories),
        )
        return reacting(found, watches)


def command(fields: int, number: int = 0) -> reactions.CommandTopic:
    """A command topic with so many numbers."""
    named = [reactions.CommandField((f"field_{n}",), False, "m/s") for n in range(fields)]
    topic = f"/command_{number}"
    return reactions.CommandTopic(topic, "geometry_msgs/Twist", tuple(named), NOWHERE)


def reacting(found: ir.Reactions, watches: int) -> ir.Machine:
    """A machine whose rules do this: a flag for each rule, then one for each watch. Memories read
    the flags of the rules.
    """
    draft = Draft()
    used = draft.input(draft.channel())
    flags = []
    for _ in range(len(found.plans) + watches):
        slot = draft.slot(used, ir.FieldKind.FLAG)
        flags.append(draft.proposition(ir.Flag(draft.signal(ir.Read(slot)))))
    for flag in flags[: len(found.plans)]:
        draft.rule(flag)
    watched = tuple(flags[len(found.plans) :])
    count = max((max(each.readings) + 1 for each in found.memories), default=0)
    readings = tuple(number % len(found.plans) for number in range(count))
    named = draft.machine("reacting")
    machine = replace(named, watches=watched, reactions=found, readings=readings)
    verify(machine)
    return machine


# --- the bench -------------------------------------------------------------------------------


class ReactorBench:
    """A reactor under test. It is opened at once, so that its limits can be seen."""

    def __init__(self, plans: Plans, order: Sequence[int] | None = None, watches: int = 0) -> None:
        machine = plans.machine(order, watches)
        self.reactor = Reactor(machine.reactions)
        self.reactor.open()
        self.watches = [TruthValue.UNKNOWN] * watches
        self._rules = len(plans.plans)

    def react(self, seconds: float, *engaged: int) -> list[str]:
        """The task commands, if these rules are engaged and no others."""
        which = [rule in engaged for rule in range(self._rules)]
        return reported(self.reactor.react(ns(seconds), which, self.watches))

    def succeed(self, seconds: float, task: int) -> list[str]:
        return reported(self.reactor.report(ns(seconds), task, True, self.watches))

    def fail(self, seconds: float, task: int) -> list[str]:
        return reported(self.reactor.report(ns(seconds), task, False, self.watches))

    def state(self, task: int) -> TaskState:
        return self.reactor.states[task]

    def wake(self) -> float | None:
        wake_ns = self.reactor.next_wake()
        return None if wake_ns is None else wake_ns / SECOND

    def bounds(self, seconds: float, number: int = 0) -> tuple[float, float, float]:
        """Factor, low and high of a field of the first command."""
        found = self.reactor.bounds(ns(seconds), 0)[number]
        return (found.factor, found.low, found.high)


def reported(task_commands: Sequence[ir.TaskCommand]) -> list[str]:
    """Task commands in words."""
    return [
        f"{task_command.kind.value} {task_command.task}"
        + ("" if task_command.by is None else f" by {task_command.by}")
        for task_command in task_commands
    ]
