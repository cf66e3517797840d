"""The task commands of a reactor that the owner of a guard has to perform."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from rossmarie.guard.decision import Request
from rossmarie.ir import Machine, TaskCommand
from rossmarie.ir.reactions import (
    Call,
    CancelGoal,
    Diagnose,
    Hook,
    Limit,
    Log,
    Publish,
    Reset,
    Retrace,
    Scale,
    SendGoal,
    SetParameter,
    SwitchControllers,
)


def requests_of(
    machine: Machine, task_commands: Sequence[TaskCommand], acted: Collection[int]
) -> Iterator[Request]:
    """The task commands that the guard does not perform itself, if actions contain the commands
    `acted`.
    """
    reactions = machine.reactions
    rules = {task: rule for rule, plan in enumerate(reactions.plans) for task in plan.tasks}
    for task_command in task_commands:
        task = reactions.tasks[task_command.task]
        match task.effect:
            case Limit() | Scale() | Reset():
                continue
            case Publish(command=int() as command) if command in acted:
                continue
            case (
                Publish() | Retrace() | Call() | SetParameter() | SwitchControllers()
                | SendGoal() | CancelGoal() | Log() | Diagnose() | Hook()
            ):  # fmt: skip
                rule = machine.rules[rules[task_command.task]].name
                action = reactions.actions[task.action].name
                yield Request(
                    task_command.kind,
                    rule,
                    action,
                    task.effect,
                    task_command.task,
                    task_command.pose,
                )
