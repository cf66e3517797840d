"""Answers about skills in the form of tests: `doing Push(Object: skiros.Box)` for a flag."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

from rossmarie import ir
from rossmarie.ir.calls import covering, query_at
from rossmarie.ir.script import FieldValue, ScriptedArrival, ScriptedReset, ScriptedSkills

Event = ScriptedArrival | ScriptedReset

DOING = "doing"
"""The word for the input about running skills. Alone, it sends the running skills once more."""


def reported_by_skills(machine: ir.Machine, events: Sequence[Event]) -> tuple[Event, ...] | None:
    """The events in order of time, with running skills instead of the flags that depend on skills.
    None if no skills give these answers.
    """
    names = _contexts(machine)
    wanted: dict[ir.Doing, bool] = {}
    found: list[Event] = []
    for event in events:
        if isinstance(event, ScriptedReset):
            found.append(event)
            continue
        flags = [setting for setting in event.settings if query_at(setting.path) is not None]
        running = None
        if flags:
            if not _note(flags, wanted):
                return None
            running = _running(machine, flags[0].topic, wanted)
            if running is None:
                return None
        found.append(_reported(event, names, running))
    return tuple(found)


def _contexts(machine: ir.Machine) -> frozenset[str]:
    """The inputs that report which skills run. No rule declares them."""
    return frozenset(
        machine.inputs[slot.input].name for slot in machine.slots if query_at(slot.path) is not None
    )


def _note(flags: Sequence[FieldValue], wanted: dict[ir.Doing, bool]) -> bool:
    """Note the answers. False if the answer to one of the queries is unknown."""
    for setting in flags:
        step = query_at(setting.path)
        if step is None or not isinstance(setting.value, bool):
            return False
        wanted[step] = setting.value
    return True


def _running(
    machine: ir.Machine, topic: str, wanted: dict[ir.Doing, bool]
) -> ScriptedSkills | None:
    calls = covering((call for call in machine.calls if call.text is not None), wanted)
    if calls is None:
        return None
    text = ", ".join(call.text or "" for call in calls) or f"{DOING} nothing"
    return ScriptedSkills(topic, tuple(call.running for call in calls), text)


def _reported(
    event: ScriptedArrival, contexts: frozenset[str], running: ScriptedSkills | None
) -> ScriptedArrival:
    inputs = [DOING if name in contexts else name for name in event.inputs]
    return dataclasses.replace(
        event,
        inputs=tuple(dict.fromkeys(each for each in inputs if running is None or each != DOING)),
        settings=tuple(each for each in event.settings if query_at(each.path) is None),
        running=running,
    )
