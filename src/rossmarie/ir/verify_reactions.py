"""Verify that the reactions of a machine are well formed. A part of `verify`.

Afterwards every index is in range, every task belongs to the plan of one rule and starts at one
place of the plan, bounds are finite and contain zero, and durations fulfil the same conditions as
those of the machine.
"""

from __future__ import annotations

import math

from rossmarie.ir import reactions
from rossmarie.ir.limits import LONGEST_NS, MOST_POSES
from rossmarie.ir.malformed import require, require_duration, require_finite, require_index
from rossmarie.ir.model import Machine


def verify_reactions(machine: Machine) -> None:
    """Raise `MalformedMachine` at the first defect of the reactions."""
    found = machine.reactions
    if found == reactions.NO_REACTIONS:
        return
    require(len(found.plans) == len(machine.rules), "plans", "not one for each rule")
    rules = list(range(len(found.plans)))
    require(sorted(found.order) == rules, "order", "not each rule once")
    place = {rule: position for position, rule in enumerate(found.order)}
    for first, second in found.priorities:
        is_kept = place.get(first, len(rules)) < place.get(second, -1)
        require(is_kept, "order", f"rule {first} is not before {second}")
    for index, memory in enumerate(found.memories):
        _verify_memory(machine, memory, f"memory {index}")
        is_used = any(_retraces(task.effect, index) for task in found.tasks)
        require(is_used, f"memory {index}", "nothing retraces it")
    for index in range(len(found.tasks)):
        _verify_task(machine, index)
    for index, plan in enumerate(found.plans):
        _verify_plan(found, plan, f"plan {index}")
    planned = sorted(task for plan in found.plans for task in plan.tasks)
    require(planned == list(range(len(found.tasks))), "plans", "not each task once")


def _verify_plan(found: reactions.Reactions, plan: reactions.RecoveryPlan, where: str) -> None:
    """Require that each task of the plan has one beginning: a place in a stage, or the failure of
    another task.
    """
    begun: set[int] = set()
    waiting = [task for stage in plan.stages for task in stage]
    while waiting:
        task = waiting.pop()
        require(task in plan.tasks, where, f"task {task} is not one of its tasks")
        require(task not in begun, where, f"task {task} begins at two places")
        begun.add(task)
        waiting.extend(found.tasks[task].otherwise)
    for task in plan.tasks:
        require(task in begun, where, f"task {task} never begins")
    for rule in plan.unless:
        require_index(rule, len(found.plans), where, "rule")


def _verify_task(machine: Machine, index: int) -> None:
    found, task = machine.reactions, machine.reactions.tasks[index]
    where = f"task {index} ({type(task.effect).__name__})"
    require_index(task.action, len(found.actions), where, "action")
    is_right = (reactions.target_of(task.effect) is None) == (task.resource is None)
    require(is_right, where, f"resource {task.resource}")
    if task.resource is not None:
        require_index(task.resource, len(found.resources), where, "resource")
    for escalation in task.otherwise:
        require_index(escalation, len(found.tasks), where, "task")
    duration_ns = reactions.timeout_ns(task.effect)
    if duration_ns is not None:
        require_duration(duration_ns, where)
    _verify_effect(machine, task.effect, where)


def _verify_effect(machine: Machine, effect: reactions.Effect, where: str) -> None:
    match effect:
        case reactions.Limit(topic=topic, bounds=bounds):
            _require_command(machine, topic, where)
            for bound in bounds:
                _verify_bound(machine.reactions.commands[topic], bound, where)
        case reactions.Scale(topic=topic, factor=factor, ramp=ramp):
            _require_command(machine, topic, where)
            require(0.0 <= factor <= 1.0, where, f"a factor of {factor}")
            _require_ramp(ramp, where)
        case reactions.Publish():
            _verify_publish(machine, effect, where)
        case reactions.Retrace():
            _verify_retrace(machine, effect, where)
        case reactions.Call(assignments=assignments) | reactions.SendGoal(assignments=assignments):
            _verify_assignments(assignments, where)
        case reactions.SetParameter(value=value):
            _require_sendable(value, where)
        case reactions.CancelGoal(confirmation=confirmation):
            if confirmation is not None:
                require_index(confirmation, len(machine.watches), where, "watch")
        case reactions.Diagnose(level=level):
            require(level is not reactions.Level.DEBUG, where, "debugging is for logs")
        case reactions.SwitchControllers() | reactions.Log() | reactions.Hook() | reactions.Reset():
            pass


def _verify_publish(machine: Machine, publish: reactions.Publish, where: str) -> None:
    if publish.command is not None:
        _require_command(machine, publish.command, where)
    if publish.period_ns is not None:
        require_duration(publish.period_ns, where)
    _verify_assignments(publish.assignments, where)


def _verify_retrace(machine: Machine, retrace: reactions.Retrace, where: str) -> None:
    require_index(retrace.memory, len(machine.reactions.memories), where, "memory")
    require_duration(retrace.period_ns, where)
    count = len(machine.reactions.memories[retrace.memory].readings)
    require(len(retrace.numbers) == count, where, f"{len(retrace.numbers)} numbers")
    _verify_assignments(retrace.assignments, where)


def _retraces(effect: reactions.Effect, memory: int) -> bool:
    return isinstance(effect, reactions.Retrace) and effect.memory == memory


def _verify_memory(machine: Machine, memory: reactions.Memory, where: str) -> None:
    require(len(memory.readings) in reactions.POSES, where, f"{len(memory.readings)} readings")
    for reading in memory.readings:
        require_index(reading, len(machine.readings), where, "reading")
    require(1 <= memory.most <= MOST_POSES, where, f"{memory.most} poses")
    require_finite((memory.apart,), where)
    require(memory.apart >= 0.0, where, f"{memory.apart} m apart")
    require(0 <= memory.apart_ns <= LONGEST_NS, where, f"{memory.apart_ns} ns apart")
    require(memory.apart > 0.0 or memory.apart_ns > 0, where, "not apart")


def _verify_assignments(assignments: tuple[reactions.Assignment, ...], where: str) -> None:
    for assignment in assignments:
        _require_sendable(assignment.value, where)


def _verify_bound(command: reactions.CommandTopic, bound: reactions.Bound, where: str) -> None:
    require_index(bound.field, len(command.fields), where, "field")
    require_finite((bound.low, bound.high), where)
    require(bound.low <= 0.0 <= bound.high, where, f"[{bound.low}, {bound.high}] lacks zero")
    _require_ramp(bound.ramp, where)


def _require_command(machine: Machine, index: int, where: str) -> None:
    require_index(index, len(machine.reactions.commands), where, "command")


def _require_ramp(ramp: float | None, where: str) -> None:
    is_fine = ramp is None or (math.isfinite(ramp) and ramp > 0.0)
    require(is_fine, where, f"a ramp of {ramp}")


def _require_sendable(value: reactions.Scalar | tuple[reactions.Scalar, ...], where: str) -> None:
    values = value if isinstance(value, tuple) else (value,)
    require_finite((each for each in values if isinstance(each, float)), where)
