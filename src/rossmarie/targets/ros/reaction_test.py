"""The placeholders of the generated test: the immediate reactions of the rules."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.targets.c99.text import indented


def blanks(machine: ir.Machine, name: str) -> dict[str, object]:
    """The values for the placeholders of the template. C has no empty tables, so each table has at
    least one row.
    """
    starts = [_start(machine, rule, task) for rule, task in _first(machine)]
    limits = [row for rule, task in _first(machine) for row in _limits(machine, rule, task)]
    commands = machine.reactions.commands
    closed = (f"check_closed({index}, {name}_FIELDS_{index});" for index in range(len(commands)))
    return {
        "starts": _rows(starts),
        "start_count": len(starts),
        "limits": _rows(limits),
        "limit_count": len(limits),
        "closed": indented(closed),
        "task_rows": max(1, len(machine.reactions.tasks)),
        "most_fields": max((len(command.fields) for command in commands), default=1),
    }


def _rows(rows: Sequence[str]) -> str:
    return "\n".join(f"    {{{row}}}," for row in rows or ["0"])


def _first(machine: ir.Machine) -> Iterator[tuple[int, int]]:
    """Each rule with each task that starts when it is engaged."""
    for rule, plan in enumerate(machine.reactions.plans):
        for task in plan.stages[0] if plan.stages else ():
            yield rule, task


def _start(machine: ir.Machine, rule: int, task: int) -> str:
    """A row of `starts`. An awaited task is in force while it runs, too."""
    effect = machine.reactions.tasks[task].effect
    stops = reactions.is_lasting(effect) or reactions.timeout_ns(effect) is not None
    return f"{rule}, {task}, {str(stops).lower()}"


def _limits(machine: ir.Machine, rule: int, task: int) -> Iterator[str]:
    """The rows of `limits` for a task."""
    effect = machine.reactions.tasks[task].effect
    match effect:
        case reactions.Limit(topic=topic, bounds=bounds):
            for bound in bounds:
                ramp = math.inf if bound.ramp is None else bound.ramp
                numbers = (1.0, bound.low, bound.high, ramp)
                yield _limit(rule, topic, bound.field, numbers)
        case reactions.Scale(topic=topic, factor=factor):
            for field in range(len(machine.reactions.commands[topic].fields)):
                yield _limit(rule, topic, field, (factor, -math.inf, math.inf, math.inf))
        case (
            reactions.Publish() | reactions.Retrace() | reactions.Call()
            | reactions.SetParameter() | reactions.SwitchControllers() | reactions.SendGoal()
            | reactions.CancelGoal() | reactions.Log() | reactions.Diagnose() | reactions.Hook()
            | reactions.Reset()
        ):  # fmt: skip
            pass


def _limit(rule: int, command: int, field: int, numbers: Sequence[float]) -> str:
    shown = (str(number).replace("inf", "INFINITY") for number in numbers)
    return ", ".join([str(rule), str(command), str(field), *shown])
