"""The tables of `rules.cpp`: the names of rules, values, inputs and tasks."""

from __future__ import annotations

from hashlib import sha256

from rossmarie import ir
from rossmarie.naming import effect_words
from rossmarie.targets.c99.names import place, string
from rossmarie.targets.c99.text import block
from rossmarie.targets.c99.types import number
from rossmarie.targets.ros import names, needs
from rossmarie.targets.ros.dialect import Dialect

_KINDS = {
    ir.FieldKind.REAL: "ValueText::NUMBER",
    ir.FieldKind.FLAG: "ValueText::FLAG",
    ir.FieldKind.TEXT: "ValueText::TEXT",
}


def blanks(machine: ir.Machine, dialect: Dialect, name: str) -> dict[str, object]:
    """The values for the placeholders of the template. `name` is the prefix of the C names."""
    rules = range(len(machine.rules))
    return {
        "texts": block(f"{name}_texts[{index}]," for index in range(len(machine.texts))),
        "rules": block(line for index in rules for line in _rule(machine, index, name)),
        "inputs": block(_input(machine, used) for used in machine.inputs),
        "task_texts": block(_task(machine, task) for task in range(len(machine.reactions.tasks))),
        "others": block(map(_other, needs.others(machine, dialect))),
        "latched_rules_key": _latched_rules_key(machine),
        "own_parameters": block(map(_parameter, ir.settings_of(machine))),
    }


def words_of(setting: ir.NodeParameter) -> tuple[str, str]:
    """The default of a parameter of the rules, and its allowed values."""
    unit = f" in {setting.unit}" if setting.unit else ""
    direction = "greater" if setting.is_up else "smaller"
    about = f"A number of the rules{unit}. Only a {direction} value, which is stricter, is allowed."
    return repr(setting.usual), about


def _parameter(setting: ir.NodeParameter) -> str:
    usual, about = words_of(setting)
    row = string(setting.name), usual, number(setting.farthest), string(about)
    return f"{{{', '.join(row)}}},"


def rule_of_task(machine: ir.Machine) -> dict[int, int]:
    """The rule of each task."""
    plans = enumerate(machine.reactions.plans)
    return {task: rule for rule, plan in plans for task in plan.tasks}


def _latched_rules_key(machine: ir.Machine) -> str:
    """A key that identifies the set of latched rules, for the name of a file."""
    latched = sorted(rule.name for rule in machine.rules if rule.release is None)
    return sha256("\n".join(latched).encode()).hexdigest()[:8]


def _value(machine: ir.Machine, index: int) -> str:
    signal = machine.signals[index]
    word = _KINDS[ir.kind_of(machine, index)]
    return f"{{{word}, {string(signal.unit)}, {number(signal.scale)}, {number(signal.offset)}}}"


def _rule(machine: ir.Machine, index: int, name: str) -> list[str]:
    rule = machine.rules[index]
    values = [_value(machine, signal) for signal in rule.signals]
    inputs = [_rule_input(machine, used) for used in rule.inputs]
    is_latched = str(rule.release is None).lower()
    parts = [f"{{{', '.join(values)}}}", f"{{{', '.join(inputs)}}}"]
    if rule.categories or rule.always:
        parts.append(f"{{{', '.join(string(each.value) for each in rule.categories)}}}")
    if rule.always:
        parts.append("true")
    return [
        f"rule_text({name}_rules[{index}], {is_latched}, // {rule.name}",
        *(f"          {part}," for part in parts[:-1]),
        f"          {parts[-1]}),",
    ]


def _rule_input(machine: ir.Machine, index: int) -> str:
    return f"{{{index}, {str(machine.inputs[index].timeout_ns is not None).lower()}}}"


def _input(machine: ir.Machine, used: ir.Input) -> str:
    return f"{{{string(used.name)}, {string(machine.channels[used.channel].topic)}}},"


def _task(machine: ir.Machine, index: int) -> str:
    task = machine.reactions.tasks[index]
    words = (
        machine.reactions.actions[task.action].name,
        effect_words(machine, task.effect),
        place(task.span),
    )
    return f"{{{rule_of_task(machine)[index]}, {', '.join(map(string, words))}}},"


def _other(other: needs.Other) -> str:
    is_service = str(other.is_service).lower()
    return f"{{{string(other.title)}, {names.relative(other.name)}, {is_service}}},"
