"""The definitions of reactions, as C: the owner of a task's resource, the effects of releases, the
end of a stage.

The input is the reactions of a machine. The definitions follow the rules of
`docs/explanation/reactions.md`, not the tables that the generator makes.
"""

from __future__ import annotations

from rossmarie.ir import overruled, reactions
from rossmarie.verification.reactor_invariants import in_force, lacks


def overruler(found: reactions.Reactions) -> str:
    """R2, for any task: the rule that owns the task's resource; -1 for its own rule or no rule."""
    rules = {task: rule for rule, plan in enumerate(found.plans) for task in plan.tasks}
    cases = []
    for index, task in enumerate(found.tasks):
        if task.resource is None:
            continue
        cases.append(f"    case {index}:")
        for rule in found.order:
            claimed = {found.tasks[each].resource for each in found.plans[rule].tasks}
            if task.resource in claimed:
                is_free = rule == rules[index] or overruled.is_shared(found, index, rule)
                taken = -1 if is_free else rule
                cases.append(f"        if (r->engaged[{rule}])\n            return {taken};")
        cases.append("        return -1;")
    body = "\n".join(cases)
    return _OVERRULER.format(cases=f"    switch (task) {{\n{body}\n    }}\n" if cases else "")


def releases(found: reactions.Reactions) -> str:
    """The body of `release`, as C, task by task (R9)."""
    lines = []
    for rule, plan in enumerate(found.plans):
        lines.append(f"    if (rule == {rule}) {{")
        for task in plan.tasks:
            lines.append(f"        if ({in_force(task)})\n            stop(r, {task});")
            lines.append(f"        r->state[{task}] = IDLE;")
        lines.append("    }")
    return "\n".join(lines)


def stages(found: reactions.Reactions) -> str:
    """The C that says whether a rule can go on to its next stage (R5)."""
    cases = []
    for rule, plan in enumerate(found.plans):
        for place, stage in enumerate(plan.stages):
            over = " && ".join(
                f"(r->state[{task}] == HOLDING || r->state[{task}] == DONE || {lacks(task)})"
                for task in stage
            )
            here = f"rule == {rule} && r->engaged[{rule}] && r->stage[{rule}] == {place}"
            cases.append(f"    if ({here})\n        return {over};")
    counts = ", ".join(str(len(plan.stages)) for plan in found.plans)
    return _STAGES.format(counts=counts, cases="\n".join(cases))


_OVERRULER = """\
/* R2: the rule that owns the resource of a task; -1 if it is the task's own rule, or none. */
static int spec_overruler(const reactor *r, unsigned task)
{{
    (void)r;
    (void)task;
{cases}    return -1;
}}
"""

_STAGES = """\
static const unsigned spec_stages[RULES] = {{{counts}}};

/* R5: say whether a rule can go on to its next stage. */
static bool spec_is_over(const reactor *r, unsigned rule)
{{
{cases}
    return false;
}}
"""
