"""What the templates of the reactor leave open: sizes, and the tables of tasks, plans and limits.

Takes a layout; gives C text. Every entry that a user's words stand behind carries them.
"""

from __future__ import annotations

from collections.abc import Iterable

from rossmarie.ir import overruled, reactions
from rossmarie.targets import comments
from rossmarie.targets.c99 import names
from rossmarie.targets.c99.layout import Layout
from rossmarie.targets.c99.text import lists, remarked_table, table
from rossmarie.targets.c99.types import duration, number


def blanks(layout: Layout) -> dict[str, object]:
    """What both templates leave open."""
    found = layout.machine.reactions
    is_confirmed = any(reactions.confirmation(task.effect) is not None for task in found.tasks)
    return {
        "guard": f"{layout.name.upper()}_REACTOR_H",
        "upper": layout.name.upper(),
        "sizes": _sizes(layout),
        "tasks": len(found.tasks),
        "rules": len(found.plans),
        "commands": len(found.commands),
        "confirmed": is_confirmed,
        "yielding": _is_yielding(found),
        "tables": "\n\n".join(_tables(found, is_confirmed=is_confirmed)),
    }


def _sizes(layout: Layout) -> str:
    found = layout.machine.reactions
    rows = [("TASKS", len(found.tasks), ""), ("COMMANDS", len(found.commands), "")]
    for index, command in enumerate(found.commands):
        remark = f" /* {comments.in_c(f'{names.place(command.span)}  {command.topic}')} */"
        rows.append((f"FIELDS_{index}", len(command.fields), remark))
    lines = [f"    {layout.name}_{name} = {size},{remark}" for name, size, remark in rows]
    lines[-1] = lines[-1].replace(",", "", 1)
    return "\n".join(lines)


def _tables(found: reactions.Reactions, *, is_confirmed: bool) -> list[str]:
    parts = [_task_tables(found), _plan_tables(found), _resource_tables(found)]
    if is_confirmed:
        watches = [reactions.confirmation(task.effect) for task in found.tasks]
        parts.append(table("index_t", "task_watch", _or_none(watches)))
    if found.commands:
        parts.append(_command_tables(found))
    return parts


# --- tasks -----------------------------------------------------------------------------------


def _task_tables(found: reactions.Reactions) -> str:
    """How long the end of each is awaited, 0 if it is not; where it is then; how it waits."""
    rows = [
        (duration(reactions.timeout_ns(task.effect) or 0), _remark(found, index))
        for index, task in enumerate(found.tasks)
    ]
    rules = {task: rule for rule, plan in enumerate(found.plans) for task in plan.tasks}
    effects = [task.effect for task in found.tasks]
    ends = ["HOLDING" if reactions.is_lasting(effect) else "DONE" for effect in effects]
    waiting = [_truth(reactions.waits(effect)) for effect in effects]
    numbers = _numbers_of_deeds(found)
    deeds = [numbers.get(overruled.deed(effect)) for effect in effects]
    answers = [
        None
        if task.resource is None
        else numbers.get(overruled.only_deed(found, rules[index], task.resource))
        for index, task in enumerate(found.tasks)
    ]
    failing = [_truth(overruled.fails_at_once(task)) for task in found.tasks]
    return "\n".join(
        [
            "/* Tasks: how long their end is awaited (0: it is not), what they are then, whether",
            " * they wait while another rule has what they need, whether they fail at once then,",
            " * what they do to that (a number), the same if their rule does nothing else to it,",
            " * and what starts when they fail.",
            " */",
            remarked_table("int64_t", "task_timeouts", rows),
            table("unsigned char", "task_end", ends),
            table("bool", "task_waits", waiting),
            table("bool", "task_fails_at_once", failing),
            table("index_t", "task_deed", _or_none(deeds)),
            table("index_t", "task_answer", _or_none(answers)),
            table("index_t", "task_rule", [rules[index] for index in range(len(effects))]),
            table("index_t", "task_resource", _or_none(task.resource for task in found.tasks)),
            lists(
                "index_t",
                "task_escalations",
                "escalations",
                [task.otherwise for task in found.tasks],
            ),
        ]
    )


def _numbers_of_deeds(found: reactions.Reactions) -> dict[overruled.Deed | None, int]:
    """A number for each thing that tasks do."""
    deeds = (overruled.deed(task.effect) for task in found.tasks)
    known = dict.fromkeys(deed for deed in deeds if deed is not None)
    return {deed: number for number, deed in enumerate(known)}


def _remark(found: reactions.Reactions, index: int) -> str:
    task = found.tasks[index]
    action = found.actions[task.action].name
    return f"{names.place(task.span)}  {action}: {task.span.text}"


def _plan_tables(found: reactions.Reactions) -> str:
    stages = [stage for plan in found.plans for stage in plan.stages]
    places = [0]
    for plan in found.plans:
        places.append(places[-1] + len(plan.stages))
    return "\n".join(
        [
            "/* Rules: from the first to the last that gets what several need; their stages; the",
            " * tasks that start with each stage; all their tasks.",
            " */",
            table("index_t", "rule_order", found.order),
            table("index_t", "rule_stages", places),
            lists("index_t", "stage_tasks", "staged_tasks", stages),
            lists("index_t", "rule_tasks", "planned_tasks", [plan.tasks for plan in found.plans]),
            *_unless_table(found),
        ]
    )


def _unless_table(found: reactions.Reactions) -> list[str]:
    """The rules while one of which is active another one is not carried out, if any are."""
    others = [plan.unless for plan in found.plans]
    return [lists("index_t", "rule_unless", "others", others)] if _is_yielding(found) else []


def _is_yielding(found: reactions.Reactions) -> bool:
    """Whether any rule is not carried out while another one is active."""
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
            "/* What tasks need for themselves, the rules that may claim it, the first first, and",
            " * what these do to it if that is one thing only:",
            *(listed or [" *   nothing"]),
            " */",
            lists("index_t", "resource_rules", "claiming_rules", claims),
            table("index_t", "claiming_deed", _or_none(deeds)),
        ]
    )


def _truth(value: bool) -> str:
    return "true" if value else "false"


def _or_none(indexes: Iterable[int | None]) -> list[str]:
    return ["NONE" if index is None else str(index) for index in indexes]


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
    return "\n".join([_COMMAND_REMARK, fields, *_limit_tables(limits), *_scale_tables(scales)])


_COMMAND_REMARK = """\
/* Commands: their fields; what tasks do to them while they are in force, and by how much that fades
 * in a second when they are not (0: at once).
 */"""


def _limit_tables(rows: list[list[tuple[int, reactions.Bound]]]) -> list[str]:
    bounds = [bound for row in rows for _, bound in row]
    tasks = [[task for task, _ in row] for row in rows]
    return [
        lists("index_t", "command_limits", "limit_task", tasks),
        table("index_t", "limit_field", [bound.field for bound in bounds]),
        table("double", "limit_low", [number(bound.low) for bound in bounds]),
        table("double", "limit_high", [number(bound.high) for bound in bounds]),
        table("double", "limit_ramp", [number(bound.ramp or 0.0) for bound in bounds]),
    ]


def _scale_tables(rows: list[list[tuple[int, reactions.Scale]]]) -> list[str]:
    scales = [scale for row in rows for _, scale in row]
    tasks = [[task for task, _ in row] for row in rows]
    return [
        lists("index_t", "command_scales", "scale_task", tasks),
        table("double", "scale_factor", [number(scale.factor) for scale in scales]),
        table("double", "scale_ramp", [number(scale.ramp or 0.0) for scale in scales]),
    ]
