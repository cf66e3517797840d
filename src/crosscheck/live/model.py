"""The messages of a robot, and the changes that are told of it, as plain data."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Running:
    """A call of a skill: `goal` is its name, `things` are pairs of a parameter and its value."""

    skill: str
    goal: str
    things: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True)
class Context:
    """The skills that run, and the digest of the export that they are from. `problem` says why the
    rules do not take the message, whatever its digest; then nothing is in it.
    """

    digest: str
    running: tuple[Running, ...] = ()
    problem: str | None = None


@dataclass(frozen=True)
class NodeState:
    """The state of the node of the rules: the active rules, and those that operators exempt."""

    active: tuple[str, ...] = ()
    exempted: tuple[str, ...] = ()


@dataclass(frozen=True)
class Alive:
    """A sign of life of the node."""


Message = Context | NodeState | Alive


class Kind(enum.Enum):
    """The kind of a change."""

    SKILL_STARTS = "skill-starts"
    SKILL_ENDS = "skill-ends"
    RULE_ACTIVATES = "rule-activates"
    RULE_CLEARS = "rule-clears"
    EXEMPTION_BEGINS = "exemption-begins"
    EXEMPTION_ENDS = "exemption-ends"
    OPERATOR_EXEMPTS = "operator-exempts"
    OPERATOR_ENDS = "operator-ends"
    TAKES = "takes"
    UNKNOWN = "unknown"
    OVER = "finding-over"


@dataclass(frozen=True)
class Change:
    """A change in words, and the names in it for programs."""

    kind: Kind
    text: str
    names: Mapping[str, str] = field(default_factory=dict)
