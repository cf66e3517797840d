"""The placeholders of the README of a generated package."""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie import ir
from rossmarie.naming import effect_words, relayed_servers, unfiltered
from rossmarie.targets.ros import needs
from rossmarie.targets.ros.dialect import Dialect


def blanks(machine: ir.Machine, dialect: Dialect) -> dict[str, object]:
    """The values for the placeholders of the template."""
    return {
        "inputs": "\n".join(_input(machine, used) for used in machine.inputs) or "- none",
        "commands": "\n".join(_relayed(machine, dialect)) or "- none",
        "others": "\n".join(map(_other, needs.others(machine, dialect))) or "- none",
        "rules": "\n".join(_rule(machine, index) for index in range(len(machine.rules))),
    }


def _input(machine: ir.Machine, used: ir.Input) -> str:
    channel = machine.channels[used.channel]
    if ir.is_setting(channel):
        return f"- `{used.name}`: a parameter of the node that can only make the rules stricter"
    timeout = "" if used.timeout_ns is None else f", timeout {used.timeout_ns / 1e9:g} s"
    return f"- `{used.name}`: `{channel.topic}` ({channel.message_type}){timeout}"


def _relayed(machine: ir.Machine, dialect: Dialect) -> Iterator[str]:
    """The topics and action servers that other nodes reach through this node."""
    for command in machine.reactions.commands:
        yield _relayed_line(command.topic, command.message_type)
    for server, action_type in (relayed_servers(machine) if dialect.relay else {}).items():
        yield _relayed_line(server, f"goals of {action_type}")


def _relayed_line(name: str, content: str) -> str:
    return f"- `{unfiltered(name)}` -> this node -> `{name}` ({content})"


def _other(other: needs.Other) -> str:
    kind = "service" if other.is_service else "topic"
    return f"- {other.title}: {kind} `{other.name}`"


def _rule(machine: ir.Machine, index: int) -> str:
    rule = machine.rules[index]
    lines = [f"- `{rule.name}`: {rule.contract}"]
    plans = machine.reactions.plans
    for task in plans[index].tasks if plans else ():
        action = machine.reactions.actions[machine.reactions.tasks[task].action].name
        effect = effect_words(machine, machine.reactions.tasks[task].effect)
        lines.append(f"  - `{action}`: {effect}")
    return "\n".join(lines)
