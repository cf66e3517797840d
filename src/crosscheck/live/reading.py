"""ROS messages as plain data. The messages are not trusted: texts are made safe for terminals, and
long texts are cut or ignored.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from typing import Any

from crosscheck.live.model import NodeState, RunningCall, RunningContext
from dslkit.diagnostics.visible import visible
from rossmarie.ir.skills import MOST_ARGUMENTS, MOST_RUNNING

LONGEST_NAME = 120
"""The most characters of a name. Digests have 64 characters, names of skills rarely more than 30.
"""
MOST_RULES = 10_000
"""The most rules of a state that are read."""


def context_of(message: Any) -> RunningContext:
    """The context in a `skill_context_msgs/SkillContext` of any ROS library."""
    digest = _text(message.digest)
    if len(message.running) > MOST_RUNNING:
        return RunningContext(digest, problem=f"more than {MOST_RUNNING} skills run")
    if any(len(each.arguments) > MOST_ARGUMENTS for each in message.running):
        return RunningContext(digest, problem=f"a skill has more than {MOST_ARGUMENTS} arguments")
    return RunningContext(digest, tuple(map(_running, message.running)))


def _running(message: Any) -> RunningCall:
    arguments = {
        _text(each.parameter): _text(each.value or each.type) for each in message.arguments
    }
    return RunningCall(_text(message.skill), _text(message.goal), tuple(arguments.items()))


def state_of(message: Any) -> NodeState:
    """A `State` of a generated node."""
    return NodeState(_texts(message.active), _texts(message.exempted))


def is_alive(message: Any, node: str) -> bool:
    """Say whether a `diagnostic_msgs/DiagnosticArray` is from a node with this full name."""
    return any(each.hardware_id == node.removeprefix("/") for each in message.status)


def _texts(found: Iterable[object]) -> tuple[str, ...]:
    return tuple(_text(each) for each in itertools.islice(found, MOST_RULES))


def _text(found: object) -> str:
    text = str(found)
    cut = text if len(text) <= LONGEST_NAME else f"{text[:LONGEST_NAME]}..."
    return visible(cut)
