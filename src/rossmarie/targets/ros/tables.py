"""The tables of `descriptions.h`: what rules, values, inputs and tasks are called."""

from __future__ import annotations

from collections.abc import Sequence
from hashlib import sha256

from rossmarie import ir
from rossmarie.naming import effect_words
from rossmarie.targets.c99.names import place, string
from rossmarie.targets.c99.types import duration, number
from rossmarie.targets.ros import names, needs
from rossmarie.targets.ros.dialect import Dialect

_KINDS = {
    ir.Kind.REAL: "ValueText::NUMBER",
    ir.Kind.FLAG: "ValueText::FLAG",
    ir.Kind.TEXT: "ValueText::TEXT",
}


def blanks(machine: ir.Machine, dialect: Dialect) -> dict[str, object]:
    """What the template leaves open; C++ has no empty tables, so each has a row at least."""
    return {
        "values": "\n\n".join(_details(machine, index) for index in range(len(machine.rules))),
        "rules": _rows([_rule(index, rule) for index, rule in enumerate(machine.rules)]),
        "inputs": _rows([_input(machine, used) for used in machine.inputs]),
        "input_count": len(machine.inputs),
        "timeouts": _rows([duration(_timeout(machine, c)) for c in range(len(machine.channels))]),
        "channel_count": len(machine.channels),
        "tasks": _rows([_task(machine, index) for index in range(len(machine.reactions.tasks))]),
        "task_count": len(machine.reactions.tasks),
        "others": _rows([_other(other) for other in needs.others(machine, dialect)]),
        "other_count": len(needs.others(machine, dialect)),
        "latched_rules_key": _latched_rules_key(machine),
    }


def rule_of_task(machine: ir.Machine) -> dict[int, int]:
    """The rule of each task."""
    plans = enumerate(machine.reactions.plans)
    return {task: rule for rule, plan in plans for task in plan.tasks}


def _latched_rules_key(machine: ir.Machine) -> str:
    """Tells sets of latched rules apart, in the name of a file."""
    latched = sorted(rule.name for rule in machine.rules if rule.release is None)
    return sha256("\n".join(latched).encode()).hexdigest()[:8]


def _timeout(machine: ir.Machine, channel: int) -> int:
    """The least timeout of the inputs of a channel in ns, 0 if none has one."""
    timeouts = (used.timeout_ns for used in machine.inputs if used.channel == channel)
    return min((timeout for timeout in timeouts if timeout is not None), default=0)


def _rows(rows: Sequence[str]) -> str:
    return "\n".join(f"    {row}," for row in rows or ["{}"])


def _details(machine: ir.Machine, index: int) -> str:
    rule = machine.rules[index]
    values = _rows([_value(machine, signal) for signal in rule.signals])
    inputs = _rows(
        [
            f"{{{used}, {str(machine.inputs[used].timeout_ns is not None).lower()}}}"
            for used in rule.inputs
        ]
    )
    return (
        f"static const ValueText values_{index}[] = {{ // of rule {rule.name}\n{values}\n}};\n"
        f"static const RuleInput inputs_{index}[] = {{\n{inputs}\n}};"
    )


def _value(machine: ir.Machine, index: int) -> str:
    signal = machine.signals[index]
    is_read = isinstance(signal.node, ir.Read)
    kind = machine.slots[signal.node.slot].kind if isinstance(signal.node, ir.Read) else None
    word = _KINDS[kind] if is_read and kind is not None else _KINDS[ir.Kind.REAL]
    return f"{{{word}, {string(signal.unit)}, {number(signal.scale)}, {number(signal.offset)}}}"


def _rule(index: int, rule: ir.Rule) -> str:
    return f"{{{str(rule.release is None).lower()}, values_{index}, inputs_{index}}}"


def _input(machine: ir.Machine, used: ir.Input) -> str:
    return f"{{{string(used.name)}, {string(machine.channels[used.channel].topic)}}}"


def _task(machine: ir.Machine, index: int) -> str:
    task = machine.reactions.tasks[index]
    words = (
        machine.reactions.actions[task.action].name,
        effect_words(machine, task.effect),
        place(task.span),
    )
    return f"{{{rule_of_task(machine)[index]}, {', '.join(map(string, words))}}}"


def _other(other: needs.Other) -> str:
    is_service = str(other.is_service).lower()
    return f"{{{string(other.title)}, {names.relative(other.name)}, {is_service}}}"
