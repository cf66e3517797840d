"""The messages of a robot, and the reported changes of its state, as plain data."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class RunningCall:
    """A call of a skill: `goal` is its name, `arguments` are pairs of a parameter and its value."""

    skill: str
    goal: str
    arguments: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True)
class RunningContext:
    """The running skills, and the digest of their export. If the rules reject the message,
    `problem` gives the reason, whatever the digest is, and the message has no skills.
    """

    digest: str
    running: tuple[RunningCall, ...] = ()
    problem: str | None = None


@dataclass(frozen=True)
class NodeState:
    """The state of the node of the rules: the active rules, and the rules that operators exempt."""

    active: tuple[str, ...] = ()
    exempted: tuple[str, ...] = ()


@dataclass(frozen=True)
class Alive:
    """A heartbeat of the node."""


Message = RunningContext | NodeState | Alive


class ChangeKind(enum.Enum):
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
class LiveChange:
    """A change in words, and its names for programs."""

    kind: ChangeKind
    text: str
    names: Mapping[str, str] = field(default_factory=dict)
