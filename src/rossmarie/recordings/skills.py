"""Queries about running skills, in the messages of recordings."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore

from rossmarie.ir import Doing, Quantity, SkillStep, Slot

_TEXT: Any = (Nodetype.BASE, ("string", 0))
_PROPOSITION: Any = (Nodetype.BASE, ("bool", 0))
_NUMBER: Any = (Nodetype.BASE, ("float64", 0))
_PACKAGE = "skill_context_msgs/msg"


def _list_of(name: str) -> Any:
    return (Nodetype.SEQUENCE, ((Nodetype.NAME, f"{_PACKAGE}/{name}"), 0))


_NEEDED: Mapping[str, Mapping[str, Any]] = {
    "SkillContext": {
        "digest": _TEXT,
        "running": _list_of("RunningSkill"),
        "ahead": _list_of("SkillAhead"),
        "is_ahead_known": _PROPOSITION,
    },
    "RunningSkill": {"skill": _TEXT, "arguments": _list_of("SkillArgument")},
    "SkillAhead": {"skill": _TEXT, "arguments": _list_of("SkillArgument")},
    "SkillArgument": {
        "parameter": _TEXT,
        "type": _TEXT,
        "number": _NUMBER,
        "properties": _list_of("SkillProperty"),
    },
    "SkillProperty": {"property": _TEXT, "number": _NUMBER},
}
"""The fields that answers depend on, in the form of rosbags."""


def query_of(slot: Slot) -> SkillStep | None:
    """The query about skills that a slot represents; None if the slot is a field."""
    match slot.path:
        case ((Doing() | Quantity()) as step,):
            return step
        case _:  # open: any other path leads to a field
            return None


def holds_skills(store: Typestore, description: Any) -> bool:
    """Say whether a description, in the form of rosbags, is a message with all these fields."""
    if description != (Nodetype.NAME, f"{_PACKAGE}/SkillContext"):
        return False
    for kind, needed in _NEEDED.items():
        name = f"{_PACKAGE}/{kind}"
        has = dict(store.fielddefs[name][1]) if name in store.fielddefs else {}
        if any(has.get(field) != described for field, described in needed.items()):
            return False
    return True
