"""Messages of ROS as plain data. They are not trusted: texts are made safe for terminals, and too
long ones are cut or ignored.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from typing import Any

from crosscheck.live.model import Context, NodeState, Running
from dslkit.diagnostics.visible import visible
from rossmarie.ir.skills import MOST_ARGUMENTS, MOST_RUNNING

LONGEST_NAME = 120
"""Characters of a name that are read; digests have 64, names of skills rarely more than 30."""
MOST_RULES = 10_000
"""Rules in a state that are read."""


def context_of(message: Any) -> Context:
    """A `skill_context_msgs/SkillContext` as libraries of ROS have it."""
    digest = _text(message.digest)
    if len(message.running) > MOST_RUNNING:
        return Context(digest, problem=f"more than {MOST_RUNNING} skills run")
    if any(len(each.arguments) > MOST_ARGUMENTS for each in message.running):
        return Context(digest, problem=f"a skill has more than {MOST_ARGUMENTS} arguments")
    return Context(digest, tuple(map(_running, message.running)))


def _running(message: Any) -> Running:
    things = {_text(each.parameter): _text(each.value or each.type) for each in message.arguments}
    return Running(_text(message.skill), _text(message.goal), tuple(things.items()))


def state_of(message: Any) -> NodeState:
    """A `State` of a generated node."""
    return NodeState(_texts(message.active), _texts(message.exempted))


def is_alive(message: Any, node: str) -> bool:
    """Say whether a `diagnostic_msgs/DiagnosticArray` is from a node, by its full name."""
    return any(each.hardware_id == node.removeprefix("/") for each in message.status)


def _texts(found: Iterable[object]) -> tuple[str, ...]:
    return tuple(_text(each) for each in itertools.islice(found, MOST_RULES))


def _text(found: object) -> str:
    text = str(found)
    cut = text if len(text) <= LONGEST_NAME else f"{text[:LONGEST_NAME]}..."
    return visible(cut)
