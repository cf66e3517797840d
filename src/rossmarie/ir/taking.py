"""Resources that a rule takes away from a skill: a topic whose commands the filter blocks, or a
server whose goals are cancelled.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rossmarie.ir import reactions
from rossmarie.ir.model import Machine
from rossmarie.skills import Use, UseKind


@dataclass(frozen=True)
class Taking:
    """A rule, the task that takes a resource away, and the skill's use of the resource."""

    rule: int
    task: reactions.Task
    use: Use


def takings(machine: Machine, uses: Sequence[Use]) -> Iterator[Taking]:
    """All resources of a skill that rules take away. Escalations are not counted, because they may
    not happen.
    """
    wanted = {(use.kind, use.name): use for use in uses}
    for rule, plan in enumerate(machine.reactions.plans):
        for index in dict.fromkeys(task for stage in plan.stages for task in stage):
            task = machine.reactions.tasks[index]
            found = taken(machine, task.effect)
            if found in wanted:
                yield Taking(rule, task, wanted[found])


def taken(machine: Machine, effect: reactions.Effect) -> tuple[UseKind, str] | None:
    """The topic or the server that an effect takes away from skills; None if there is none."""
    commands = machine.reactions.commands
    match effect:
        case reactions.Limit(topic=topic) if reactions.is_block(commands[topic], effect):
            return UseKind.TOPIC, commands[topic].topic
        case reactions.Scale(topic=topic, factor=0.0):
            return UseKind.TOPIC, commands[topic].topic
        case reactions.Publish(command=command) if command is not None:
            return UseKind.TOPIC, commands[command].topic
        case reactions.SendGoal(server=server) | reactions.CancelGoal(server=server):
            return UseKind.SERVER, server
        case (
            reactions.Limit() | reactions.Scale() | reactions.Publish() | reactions.Retrace()
            | reactions.Call() | reactions.SetParameter() | reactions.SwitchControllers()
            | reactions.Log() | reactions.Diagnose() | reactions.Hook() | reactions.Reset()
        ):  # fmt: skip
            return None
