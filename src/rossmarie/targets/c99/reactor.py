"""The placeholders of the templates of the reactor: sizes, and the tables of tasks, plans and
limits.

The input is a layout; the result is C text. Every entry that stands for a user's text contains the
text as a comment.
"""

from __future__ import annotations

from collections.abc import Sequence

from rossmarie.ir import overruled, reactions
from rossmarie.targets import comments
from rossmarie.targets.c99 import names
from rossmarie.targets.c99.layout import CLayout
from rossmarie.targets.c99.text import boolean, lists, remarked_table, sizes, starts_of, table
from rossmarie.targets.c99.types import duration, number


def blanks(layout: CLayout) -> dict[str, object]:
    """The values for the placeholders of both templates."""
    found = layout.machine.reactions
    return {
        "guard": f"{layout.name.upper()}_REACTOR_H",
        "upper": layout.name.upper(),
        "sizes": _sizes(layout),
        "counts": sizes(_counts(found)),
        "tasks": len(found.tasks),
        "rules": len(found.plans),
        "commands": len(found.commands),
        "memories": len(found.memories),
        "retraces": len(retraces_of(found)),
        "pose_numbers": sum(each.most * len(each.readings) for each in found.memories),
        "most_numbers": _most_numbers(found),
        "tables": "\n\n".join(_tables(found)),
    }


def _counts(found: reactions.Reactions) -> dict[str, int]:
    """The sizes of the parts of a reactor. A part without an entry has size 0."""
    used = {
        "COMMANDS": len(found.commands),
        "SCALES": sum(isinstance(task.effect, reactions.Scale) for task in found.tasks),
        "ESCALATIONS": sum(len(task.otherwise) for task in found.tasks),
        "CONFIRMED": sum(
            1 for each in found.tasks if reactions.confirmation(each.effect) is not None
        ),
        "RETRACES": len(retraces_of(found)),
        "MEMORIES": len(found.memories),
        "MOST_NUMBERS": _most_numbers(found),
        "YIELDING": sum(1 for each in found.plans if each.unless),
    }
    counts = {"TASKS": len(found.tasks), "RULES": len(found.plans)}
    return {**counts, **{name: count for name, count in used.items() if count}}


def _sizes(layout: CLayout) -> str:
    found = layout.machine.reactions
    rows = [("TASKS", len(found.tasks), ""), ("COMMANDS", len(found.commands), "")]
    for index, command in enumerate(found.commands):
        remark = f" /* {comments.in_c(f'{names.place(command.span)}  {command.topic}')} */"
        rows.append((f"FIELDS_{index}", len(command.fields), remark))
    lines = [f"    {layout.name}_{name} = {size},{remark}" for name, size, remark in rows]
    lines[-1] = lines[-1].replace(",", "", 1)
    return "\n".join(lines)


def _tables(found: reactions.Reactions) -> list[str]:
    parts = [_task_tables(found), _plan_tables(found), _resource_tables(found)]
    if found.commands:
        parts.append(_command_tables(found))
    if found.memories:
        parts.append(_memory_tables(found))
    return parts


# --- tasks -----------------------------------------------------------------------------------


def _task_tables(found: reactions.Reactions) -> str:
    """A row for each task, and the tasks that start after a failure of each task."""
    rules = {task: rule for rule, plan in enumerate(found.plans) for task in plan.tasks}
    rows = [(_task_row(found, index, rules[index]), _remark(found, index)) for index in rules]
    otherwise = [task.otherwise for task in found.tasks]
    return "\n".join(
        [
            "/* Tasks, with the columns of `plan` in engine/plans.h; then the escalations that",
            " * start after a failure of each task, if there are any.",
            " */",
            remarked_table("plan", "tasks", rows),
            *_escalation_table(otherwise),
        ]
    )


def _escalation_table(otherwise: Sequence[Sequence[int]]) -> list[str]:
    """The tasks that start after a failure of each task, if there are any."""
    rows = _named("task", otherwise)
    return [lists("task_escalations", "escalations", rows)] if any(otherwise) else []


def _task_row(found: reactions.Reactions, index: int, rule: int) -> str:
    """A task in the format of `plan` in the engine."""
    task = found.tasks[index]
    numbers = _numbers_of_deeds(found)
    needed = task.resource
    answer = None if needed is None else numbers.get(overruled.only_deed(found, rule, needed))
    fields = [
        str(rule),
        duration(reactions.timeout_ns(task.effect) or 0),
        "HOLDING" if reactions.is_lasting(task.effect) else "DONE",
        boolean(reactions.waits(task.effect)),
        boolean(overruled.fails_at_once(task)),
        _or_none(task.resource),
        _or_none(numbers.get(overruled.deed(task.effect))),
        _or_none(answer),
        _or_none(reactions.confirmation(task.effect)),
    ]
    return f"{{{', '.join(fields)}}}"


def _numbers_of_deeds(found: reactions.Reactions) -> dict[overruled.Deed | None, int]:
    """A number for each deed of tasks."""
    deeds = (overruled.deed(task.effect) for task in found.tasks)
    known = dict.fromkeys(deed for deed in deeds if deed is not None)
    return {deed: number for number, deed in enumerate(known)}


def _remark(found: reactions.Reactions, index: int) -> str:
    task = found.tasks[index]
    action = found.actions[task.action].name
    return f"{names.place(task.span)}  {action}: {task.span.text}"


def _plan_tables(found: reactions.Reactions) -> str:
    stages = [stage for plan in found.plans for stage in plan.stages]
    planned = [plan.tasks for plan in found.plans]
    return "\n".join(
        [
            "/* Rules, in the order in which they own resources; then the stages of each rule, the",
            " * tasks of each stage, and all tasks of each rule.",
            " */",
            table("index_t", "rule_order", found.order),
            table("index_t", "rule_stages", starts_of(len(plan.stages) for plan in found.plans)),
            lists("stage_tasks", "staged_tasks", _named("stage", stages)),
            lists("rule_tasks", "planned_tasks", _named("rule", planned)),
            *_unless_table(found),
        ]
    )


def _unless_table(found: reactions.Reactions) -> list[str]:
    """For each rule, the rules that suspend it while they are active; empty if there are none."""
    others = [plan.unless for plan in found.plans]
    return [lists("rule_unless", "others", _named("rule", others))] if _is_yielding(found) else []


def _is_yielding(found: reactions.Reactions) -> bool:
    """Say whether any rule gives way to another rule."""
    return any(plan.unless for plan in found.plans)


def _resource_tables(found: reactions.Reactions) -> str:
    claims = [
        [
            rule
            for rule in found.order
            if any(found.tasks[task].resource == resource for task in found.plans[rule].tasks)
        ]
        for resource in range(len(found.resources))
    ]
    numbers = _numbers_of_deeds(found)
    deeds = [
        numbers.get(overruled.only_deed(found, rule, resource))
        for resource, rules in enumerate(claims)
        for rule in rules
    ]
    listed = [
        f" *   {index}: {comments.in_c(resource)}" for index, resource in enumerate(found.resources)
    ]
    return "\n".join(
        [
            "/* Resources: the rules that claim each resource, in the order in which they own it;",
            " * and the deed of each of these rules, if it uses the resource in one way only.",
            *(listed or [" *   There are no resources."]),
            " */",
            lists(
                "resource_rules", "claiming_rules", list(zip(found.resources, claims, strict=True))
            ),
            table("index_t", "claiming_deed", list(map(_or_none, deeds))),
        ]
    )


def _named(kind: str, rows: Sequence[Sequence[int]]) -> list[tuple[str, Sequence[int]]]:
    """Lists, each with its name."""
    return [(f"{kind} {index}", row) for index, row in enumerate(rows)]


def _or_none(index: int | None) -> str:
    return "NONE" if index is None else str(index)


# --- memories --------------------------------------------------------------------------------


def retraces_of(found: reactions.Reactions) -> list[tuple[int, reactions.Retrace]]:
    """The tasks that retrace, with their indexes."""
    effects = enumerate(task.effect for task in found.tasks)
    return [(task, each) for task, each in effects if isinstance(each, reactions.Retrace)]


def _most_numbers(found: reactions.Reactions) -> int:
    return max((len(each.readings) for each in found.memories), default=0)


def _memory_tables(found: reactions.Reactions) -> str:
    """The memories of poses, the rules that retrace each memory, and the tasks that retrace."""
    rows = []
    first = reading = 0
    for each in found.memories:
        sizes_of_it = f"{first}, {reading}, {each.most}, {len(each.readings)}"
        rows.append(f"{{{sizes_of_it}, {number(each.apart)}, {duration(each.apart_ns)}}}")
        first += each.most * len(each.readings)
        reading += len(each.readings)
    users = [
        [
            rule
            for rule, plan in enumerate(found.plans)
            if any(
                task in plan.tasks and each.memory == memory for task, each in retraces_of(found)
            )
        ]
        for memory in range(len(found.memories))
    ]
    sending = [
        (f"{{{task}, {each.memory}, {duration(each.period_ns)}}}", _remark(found, task))
        for task, each in retraces_of(found)
    ]
    readings = [reading for each in found.memories for reading in each.readings]
    names_of = [f"memory {index}" for index in range(len(found.memories))]
    return "\n".join(
        [
            "/* Memories of poses, with the columns of `memory` in engine/plans.h: first number,",
            " * first reading, greatest number of poses, numbers in a pose, least distance in m",
            " * and in ns. Then the readings, the rules that retrace each memory, and the tasks",
            " * that retrace.",
            " */",
            remarked_table("memory", "memories", list(zip(rows, names_of, strict=True))),
            table("index_t", "pose_readings", readings),
            lists("pose_rules", "pose_users", list(zip(names_of, users, strict=True))),
            remarked_table("retrace", "retraces", sending),
        ]
    )


# --- commands --------------------------------------------------------------------------------


def _command_tables(found: reactions.Reactions) -> str:
    effects = list(enumerate(task.effect for task in found.tasks))
    commands = range(len(found.commands))
    limits = [
        [
            (index, bound)
            for index, effect in effects
            if isinstance(effect, reactions.Limit) and effect.topic == command
            for bound in effect.bounds
        ]
        for command in commands
    ]
    scales = [
        [
            (index, effect)
            for index, effect in effects
            if isinstance(effect, reactions.Scale) and effect.topic == command
        ]
        for command in commands
    ]
    fields = table("index_t", "command_fields", [len(each.fields) for each in found.commands])
    return "\n".join(
        [
            "/* Commands: the number of fields, and the bounds and factors of tasks. */",
            fields,
            *_limit_tables(found, limits),
            *_scale_tables(found, scales),
        ]
    )


def _limit_tables(
    found: reactions.Reactions, rows: list[list[tuple[int, reactions.Bound]]]
) -> list[str]:
    """The bounds of each command. The bounds of command c have the indexes from command_limits[c]
    up to, not including, command_limits[c + 1].
    """
    listed = [
        (
            f"{{{task}, {bound.field}, {number(bound.low)}, {number(bound.high)}, "
            f"{number(bound.ramp or 0.0)}}}",
            _remark(found, task),
        )
        for row in rows
        for task, bound in row
    ]
    return [
        table("index_t", "command_limits", starts_of(map(len, rows))),
        remarked_table("bound", "bounding", listed or [("{0, 0, 0.0, 0.0, 0.0}", "none")]),
    ]


def _scale_tables(
    found: reactions.Reactions, rows: list[list[tuple[int, reactions.Scale]]]
) -> list[str]:
    listed = [
        (
            f"{{{task}, {number(scale.factor)}, {number(scale.ramp or 0.0)}}}",
            _remark(found, task),
        )
        for row in rows
        for task, scale in row
    ]
    starts = table("index_t", "command_scales", starts_of(map(len, rows)))
    return [starts, remarked_table("scale", "scales", listed)] if listed else []
