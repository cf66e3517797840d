"""A replay as JSON lines: a header, then one object for each event, in the order of events. The
task commands that an event would have caused follow it.

`docs/reference/verdicts.md` describes the schema. `SCHEMA` is increased when a reader of the old
schema could misread the new schema.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from itertools import groupby

from rossmarie.ir import (
    Cause,
    Change,
    Event,
    Explanation,
    InputState,
    Machine,
    Reading,
    Rule,
    StaleInput,
    TruthValue,
    Verdict,
    explain,
)
from rossmarie.report.axis import PlacedEvent, place
from rossmarie.report.model import Replay
from rossmarie.report.rehearsal import Rehearsed, rehearse, task_words

SCHEMA = 1

CHANGES = {
    Change.CLEARED: "cleared",
    Change.ACTIVATED: "activated",
    Change.ACTIVATED_STALE: "activated_stale",
}
TRUTH_VALUES = {
    TruthValue.FALSE: "false",
    TruthValue.TRUE: "true",
    TruthValue.UNKNOWN: "unknown",
    TruthValue.STALE: "stale",
}
STATES = {InputState.NEVER: "never", InputState.FRESH: "unusable", InputState.EXPIRED: "expired"}


def verdict_lines(replay: Replay) -> Iterator[str]:
    """The lines of the file, without line endings."""
    yield _line(_header(replay))
    yield from _event_lines(replay.machine, replay.events, replay.start_ns, replay.rehearsed)


def event_lines(
    machine: Machine, events: Sequence[Event], start_ns: int, end_ns: int
) -> Iterator[str]:
    """The lines after the header, without line endings: the events of any monitor or guard between
    two instants.
    """
    return _event_lines(machine, events, start_ns, rehearse(machine, events, end_ns))


def _event_lines(
    machine: Machine, events: Sequence[Event], start_ns: int, rehearsed: Sequence[Rehearsed]
) -> Iterator[str]:
    following = groupby(rehearsed, key=lambda each: each.after)
    task_commands = {after: list(those) for after, those in following}
    for index, placed in enumerate(place(events, start_ns)):
        yield _line(_event(machine, placed))
        for each in task_commands.get(index, ()):
            yield _line(_task_command(machine, each, placed))


def _line(fields: dict[str, object]) -> str:
    return json.dumps(fields, ensure_ascii=False, allow_nan=False, separators=(", ", ": "))


def _header(replay: Replay) -> dict[str, object]:
    left_out = replay.machine.left_out
    return {
        "type": "header",
        "schema": SCHEMA,
        "generator": "rossmarie",
        "rules_file": replay.rules_file,
        "recording": replay.recording,
        "monitor": replay.monitor,
        "start_ns": replay.start_ns,
        "end_ns": replay.end_ns,
        "duration_s": replay.duration_ns / 1e9,
        "rules": [rule.name for rule in replay.machine.rules],
        "left_out": [] if left_out is None else list(left_out.rules),
        "notes": list(replay.notes),
    }


def _event(machine: Machine, placed: PlacedEvent) -> dict[str, object]:
    event = placed.event
    if isinstance(event, Verdict):
        return _verdict(machine, event, placed)
    return {
        "type": "time_jump",
        "from_ns": event.from_ns,
        "to_ns": event.to_ns,
        "time_s": placed.position_ns / 1e9,
    }


def _verdict(machine: Machine, verdict: Verdict, placed: PlacedEvent) -> dict[str, object]:
    rule = machine.rules[verdict.rule]
    return {
        "type": "verdict",
        "rule": rule.name,
        "at_ns": verdict.at_ns,
        "time_s": placed.position_ns / 1e9,
        "active": verdict.change is not Change.CLEARED,
        "change": CHANGES[verdict.change],
        "categories": [each.value for each in rule.categories],
        "actions": list(rule.actions),
        "clears": rule.contract,
        "exempts": _exemption(rule),
        "cause": cause_data(explain(machine, verdict), placed.origin_ns),
    }


def _exemption(rule: Rule) -> dict[str, object] | None:
    """The exemption that a rule stands for, and its permissions."""
    exempts = rule.exempts
    if exempts is None:
        return None
    return {"rule": exempts.rule, "doing": exempts.doing, "permits": list(exempts.permits)}


def _task_command(machine: Machine, each: Rehearsed, placed: PlacedEvent) -> dict[str, object]:
    command = each.command
    action, effect = task_words(machine, command.task)
    return {
        "type": "task_command",
        "command": command.kind.value,
        "at_ns": placed.at_ns + each.later_ns,
        "time_s": (placed.position_ns + each.later_ns) / 1e9,
        "rule": machine.rules[each.rule].name,
        "action": action,
        "effect": effect,
        "by": None if command.by is None else machine.rules[command.by].name,
    }


def cause_data(explanation: Explanation, origin_ns: int) -> dict[str, object]:
    """The object `cause` of a verdict; seconds count from the stamp `origin_ns`."""
    return {
        "text": explanation.line(origin_ns),
        "conditions": [_condition(cause, origin_ns) for cause in explanation.causes],
        "stale_inputs": [_stale_input(stale) for stale in explanation.stale_inputs],
    }


def _condition(cause: Cause, origin_ns: int) -> dict[str, object]:
    return {
        "name": cause.name,
        "text": cause.text,
        "truth": TRUTH_VALUES[cause.value],
        "since_ns": cause.since_ns,
        "since_s": (cause.since_ns - origin_ns) / 1e9,
        "values": [_reading(reading) for reading in cause.readings],
    }


def _reading(reading: Reading) -> dict[str, object]:
    return {
        "signal": reading.text,
        "value": json_number(reading.value),
        "unit": reading.unit,
        "shown": reading.shown,
    }


def _stale_input(stale: StaleInput) -> dict[str, object]:
    state = "was stale" if stale.was_stale else STATES[stale.state]
    return {"name": stale.name, "topic": stale.topic, "state": state}


def json_number(value: float) -> float | str | None:
    """A number in the form of JSON: NaN is null, an infinity is `"Infinity"` or `"-Infinity"`."""
    if math.isnan(value):
        return None
    if math.isinf(value):
        return "Infinity" if value > 0 else "-Infinity"
    return value
