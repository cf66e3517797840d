"""Tasks that wait while another rule owns their resource, and the instant at which they fail.

`docs/explanation/reactions.md` defines this (R7, R8, R15).
"""

from __future__ import annotations

from rossmarie.ir import reactions
from rossmarie.ir.reactions import Effect, Reactions, Task


def fails_at_once(task: Task) -> bool:
    """Say whether a task fails as soon as it waits: it has no time limit that could expire, but an
    escalation.
    """
    is_awaited = reactions.timeout_ns(task.effect) is not None
    return reactions.waits(task.effect) and not is_awaited and bool(task.otherwise)


def may_be_overdue(task: Task) -> bool:
    """Say whether a task can fail while it waits."""
    is_awaited = reactions.timeout_ns(task.effect) is not None
    return fails_at_once(task) or (reactions.waits(task.effect) and is_awaited)


def can_fail(task: Task) -> bool:
    """Say whether a task can ever get the task command FAILED."""
    is_awaited = reactions.timeout_ns(task.effect) is not None
    is_stale = task.resource is not None and not reactions.waits(task.effect)
    return is_awaited or is_stale or fails_at_once(task)


Deed = tuple[object, ...]


def deed(effect: Effect) -> Deed | None:
    """The deed of an effect on its resource, if several tasks can do it together, or one task in
    place of another; else None.
    """
    match effect:
        case reactions.CancelGoal(server=server):
            return ("cancel", server)
        case reactions.SetParameter(node=node, parameter=parameter, value=value):
            return ("set", node, parameter, type(value), value)
        case reactions.SwitchControllers(manager=manager, start=start, stop=stop):
            return ("switch", manager, frozenset(start), frozenset(stop))
        case reactions.Publish(command=command):
            return ("publish", effect) if command is None else None
        case (
            reactions.Limit() | reactions.Scale() | reactions.Retrace() | reactions.Call()
            | reactions.SendGoal() | reactions.Log() | reactions.Diagnose() | reactions.Hook()
            | reactions.Reset()
        ):  # fmt: skip
            return None


def only_deed(found: Reactions, rule: int, resource: int) -> Deed | None:
    """The deed of a rule on a resource, if the rule does only one thing with it."""
    tasks = (found.tasks[task] for task in found.plans[rule].tasks)
    first, *others = {deed(task.effect) for task in tasks if task.resource == resource}
    return None if others else first


def does_the_same(found: Reactions, task: int, owner: int) -> bool:
    """Say whether the owner uses the resource of a task only in the same way as the task itself."""
    declared = found.tasks[task]
    own = deed(declared.effect)
    if own is None or declared.resource is None:
        return False
    return own == only_deed(found, owner, declared.resource)


def is_shared(found: Reactions, task: int, owner: int) -> bool:
    """Say whether the owner of a task's resource lets the task use it: both only publish the same
    message (R2).
    """
    is_published = isinstance(found.tasks[task].effect, reactions.Publish)
    return is_published and does_the_same(found, task, owner)
