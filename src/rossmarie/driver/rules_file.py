"""The description of a rules file for other programs: `rules.json`.

`docs/reference/rules-file.md` describes its keys.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from dslkit.source import SourceFile, Span
from rossmarie import ir
from rossmarie.driver.sources import name_of
from rossmarie.ir import reactions
from rossmarie.naming import effect_target

FORMAT = "rossmarie/rules"
VERSION = 1

WORDS: Mapping[type, str] = {
    reactions.Scale: "scale",
    reactions.Publish: "publish",
    reactions.Retrace: "retrace",
    reactions.Call: "call",
    reactions.SetParameter: "set",
    reactions.SwitchControllers: "switch",
    reactions.SendGoal: "send",
    reactions.CancelGoal: "cancel",
    reactions.Log: "log",
    reactions.Diagnose: "diagnose",
    reactions.Hook: "hook",
    reactions.Reset: "reset",
}
"""The words for effects. A limit may also be a block."""

Json = dict[str, "Json"] | list["Json"] | str | int | float | bool | None


def rules_file(machine: ir.Machine, sources: Sequence[SourceFile], out: Path) -> str:
    """The text of the file `out`. Paths in it are relative to its folder, except for files of the
    library. `sources` are all files that the machine depends on. Equal sources give equal texts.
    """
    read = sorted((name_of(Path(each.path), out), each.sha256) for each in sources)
    whole: Json = {
        "format": FORMAT,
        "version": VERSION,
        "digest": hashlib.sha256(json.dumps([VERSION, read]).encode()).hexdigest(),
        "sources": [{"path": path, "sha256": digest} for path, digest in read],
        "name": machine.name,
        "inputs": [_input(machine, each, out) for each in machine.inputs],
        "commands": [_command(each, out) for each in machine.reactions.commands],
        "rules": [_rule(machine, index, out) for index in range(len(machine.rules))],
    }
    return json.dumps(whole, indent=1, allow_nan=False) + "\n"


def _place(span: Span, out: Path) -> Json:
    """A place with lines and columns from 1, as in findings. The end is after the last
    character.
    """
    return {
        "path": name_of(Path(span.file.path), out),
        "line": span.begin.line,
        "column": span.begin.column,
        "end_line": span.finish.line,
        "end_column": span.finish.column,
    }


def _input(machine: ir.Machine, used: ir.Input, out: Path) -> Json:
    channel = machine.channels[used.channel]
    return {
        "name": used.name,
        "topic": channel.source,
        "type": channel.source_type,
        "timeout": None if used.timeout_ns is None else used.timeout_ns / 1e9,
        "place": _place(used.span, out),
    }


def _command(command: reactions.CommandTopic, out: Path) -> Json:
    return {
        "topic": command.topic,
        "type": command.message_type,
        "place": _place(command.span, out),
    }


def _rule(machine: ir.Machine, index: int, out: Path) -> Json:
    rule = machine.rules[index]
    return {
        "name": rule.name,
        "documentation": rule.documentation,
        "condition": machine.propositions[rule.condition].text,
        "clears": rule.contract,
        "inputs": [machine.inputs[each].name for each in rule.inputs],
        "hazards": [machine.hazards[each].name for each in rule.hazards],
        "categories": [each.value for each in rule.categories],
        "unless": [machine.rules[each].name for each in _plan(machine, index).unless],
        "always": rule.always,
        "exempts": None if rule.exempts is None else _exemption(rule.exempts),
        "effects": list(_effects(machine, index, out)),
        "place": _place(rule.head, out),
    }


def _exemption(exemption: ir.Exemption) -> Json:
    return {
        "rule": exemption.rule,
        "doing": exemption.doing,
        "permits": list(exemption.permits),
    }


def _plan(machine: ir.Machine, rule: int) -> reactions.RecoveryPlan:
    plans = machine.reactions.plans
    return plans[rule] if plans else reactions.RecoveryPlan((), ())


def _effects(machine: ir.Machine, rule: int, out: Path) -> Iterator[Json]:
    for index in _plan(machine, rule).tasks:
        task = machine.reactions.tasks[index]
        yield {
            "action": machine.reactions.actions[task.action].name,
            "kind": _word(machine, task.effect),
            "name": effect_target(machine, task.effect),
            "place": _place(task.span, out),
        }


def _word(machine: ir.Machine, effect: reactions.Effect) -> str:
    """The word of the language for an effect."""
    if isinstance(effect, reactions.Limit):
        command = machine.reactions.commands[effect.topic]
        return "block" if reactions.is_block(command, effect) else "limit"
    return WORDS[type(effect)]
