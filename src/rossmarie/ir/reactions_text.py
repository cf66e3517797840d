"""Reactions as text for readers: one line per part. A part of `dump_text`.

Tasks are written as `k0`, rules by name. The place in the rules file follows the bar.
"""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie.ir import reactions
from rossmarie.ir.duration_text import duration_text
from rossmarie.ir.model import Machine
from rossmarie.ir.path import path_words

_WIDTH = 44


def reaction_sections(machine: Machine) -> Iterator[tuple[str, ...]]:
    """The lines of each part: watches, command topics, resources, actions, tasks, plans."""
    found = machine.reactions
    yield tuple(
        f"watch {index} = t{proposition}" for index, proposition in enumerate(machine.watches)
    )
    yield tuple(f"reading {index} = s{signal}" for index, signal in enumerate(machine.readings))
    yield tuple(map(_memory, enumerate(found.memories)))
    yield tuple(line for index in range(len(found.commands)) for line in _command(found, index))
    yield tuple(f"resource {index} = {name}" for index, name in enumerate(found.resources))
    yield tuple(
        _placed(f"action {index} = {action.name}", str(action.span))
        for index, action in enumerate(found.actions)
    )
    yield tuple(_task(found, index) for index in range(len(found.tasks)))
    yield tuple(_plans(machine))


def _placed(line: str, place: str) -> str:
    return f"{line:{_WIDTH}} | {place}"


def _memory(numbered: tuple[int, reactions.Memory]) -> str:
    index, memory = numbered
    readings = " ".join(map(str, memory.readings))
    apart = f"{memory.apart!r} m and {duration_text(memory.apart_ns)} apart"
    return f"memory {index} = up to {memory.most} of readings {readings}, {apart}"


def _command(found: reactions.Reactions, index: int) -> Iterator[str]:
    command = found.commands[index]
    yield _placed(f"command {index} = {command.topic} : {command.message_type}", str(command.span))
    for number, field in enumerate(command.fields):
        elements = " elements" if field.is_array else ""
        unit = f" in {field.unit}" if field.unit else ""
        yield f"  field {number} = {path_words(field.path)}{elements}{unit}"


def _task(found: reactions.Reactions, index: int) -> str:
    task = found.tasks[index]
    resource = "" if task.resource is None else f", resource {task.resource}"
    otherwise = f", otherwise {_tasks(task.otherwise)}" if task.otherwise else ""
    line = f"k{index} = {_effect(task.effect)}, action {task.action}{resource}{otherwise}"
    return _placed(line, str(task.span))


def _plans(machine: Machine) -> Iterator[str]:
    found = machine.reactions
    for rule, plan in zip(machine.rules, found.plans, strict=False):
        stages = ", then ".join(map(_tasks, plan.stages)) or "nothing"
        others = ", ".join(machine.rules[other].name for other in plan.unless)
        yield f"plan of {rule.name} = {stages}{f' unless {others}' if others else ''}"
    if found.order:
        yield f"order {', '.join(machine.rules[rule].name for rule in found.order)}"


def _effect(effect: reactions.Effect) -> str:
    match effect:
        case reactions.Limit(topic=topic, bounds=bounds):
            return f"limit command {topic} to {', '.join(map(_bound, bounds)) or 'nothing'}"
        case reactions.Scale(topic=topic, factor=factor, ramp=ramp):
            return f"scale command {topic} by {factor!r}{_ramp(ramp)}"
        case reactions.Publish(topic=topic, message_type=kind, period_ns=period_ns):
            rate = "once" if period_ns is None else f"every {duration_text(period_ns)}"
            place = "" if effect.command is None else f" in the place of command {effect.command}"
            return f"publish {topic} : {kind} {_fields(effect.assignments)} {rate}{place}"
        case reactions.Retrace(topic=topic, message_type=kind, memory=memory):
            sent = f"{topic} : {kind} {_fields(effect.assignments)}"
            return f"retrace memory {memory} on {sent} every {duration_text(effect.period_ns)}"
        case reactions.Log(level=level, text=text):
            return f"log {level.value} {text!r}"
        case reactions.Diagnose(level=level, text=text):
            return f"diagnose {level.value} {text!r}"
        case reactions.Hook(name=name):
            return f"hook {name}"
        case reactions.Reset():
            return "reset"
        case (
            reactions.Call() | reactions.SetParameter() | reactions.SwitchControllers()
            | reactions.SendGoal() | reactions.CancelGoal()
        ):  # fmt: skip
            return f"{_awaited(effect)} within {duration_text(effect.timeout_ns)}"


def _awaited(effect: reactions.Awaited) -> str:
    match effect:
        case reactions.Call(service=service, service_type=kind, assignments=assignments):
            return f"call {service} : {kind} {_fields(assignments)}"
        case reactions.SetParameter(node=node, parameter=parameter, value=value):
            return f"set {node}.{parameter} to {value!r}"
        case reactions.SwitchControllers(manager=manager, start=start, stop=stop):
            return f"switch {manager} start {_names(start)} stop {_names(stop)}"
        case reactions.SendGoal(server=server, action_type=kind, assignments=assignments):
            sent = f"send {kind} {_fields(assignments)} to {server}"
            return f"{sent} then {effect.interrupted.value}"
        case reactions.CancelGoal(server=server, confirmation=confirmation):
            confirmed = "" if confirmation is None else f" confirm by watch {confirmation}"
            return f"cancel {server}{confirmed} then {effect.interrupted.value}"


def _bound(bound: reactions.Bound) -> str:
    return f"field {bound.field} in [{bound.low!r}, {bound.high!r}]{_ramp(bound.ramp)}"


def _ramp(ramp: float | None) -> str:
    return "" if ramp is None else f" ramp {ramp!r} a second"


def _fields(assignments: tuple[reactions.Assignment, ...]) -> str:
    inside = "; ".join(f"{path_words(each.path)}: {each.value!r}" for each in assignments)
    return f"{{{inside}}}"


def _tasks(tasks: tuple[int, ...]) -> str:
    return " ".join(f"k{task}" for task in tasks) or "nothing"


def _names(names: tuple[str, ...]) -> str:
    return ", ".join(names) or "nothing"
