"""Guards in front of primitives, from a file of `crosscheck weave`, and the known state of their
rules while a robot runs.

An unknown state is not safe: while the active rules are unknown, each guarded primitive waits.
"""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from dslkit.diagnostics import Diagnostic
from dslkit.diagnostics.visible import visible
from dslkit.source import SourceFile
from ezskiros.context.errors import NoGuards, OtherGuards
from ezskiros.export.read import Export, NotJsonError, place_of_key, read_json, wrong_format

FORMAT = "crosscheck/guards"
VERSION = 1
PATIENCE = 3.0
"""The seconds after which a silent node is not trusted. The node reports once a second."""
_SHAPES = {
    "digest": re.compile(r"[0-9a-f]{64}"),
    "node": re.compile(r"[A-Za-z]\w*", re.ASCII),
    "topic": re.compile(r"[A-Za-z]\w*(/[A-Za-z]\w*)*", re.ASCII),
    "type": re.compile(r"[A-Za-z]\w*/[A-Za-z]\w*", re.ASCII),
}
_MOST_RULES = 10_000
"""The most rules that are read from a message."""
_LONGEST_NAME = 120


@dataclass(frozen=True)
class Guards:
    """The rules that each skill waits for, by skill name; all `rules` of the node; and the topic on
    which the node reports the active rules.
    """

    file: SourceFile
    digest: str
    node: str
    topic: str
    type: str
    rules: frozenset[str]
    guards: Mapping[str, tuple[str, ...]]


def read_guards(path: Path) -> Guards | Diagnostic:
    """The guards in a file, or the finding that explains why there are none. Raises `OSError` if
    the file cannot be read.
    """
    try:
        file, found = read_json(path)
    except NotJsonError as problem:
        return NoGuards(path=problem.place.file.path, reason=str(problem)).at(problem.place)
    wrong = _fault(found)
    if wrong is not None:
        key, why = wrong
        return NoGuards(path=file.path, reason=why).at(place_of_key(file, key))
    return Guards(
        file=file,
        rules=frozenset(found["rules"]),
        guards={skill: tuple(rules) for skill, rules in found["guards"].items()},
        **{key: found[key] for key in _SHAPES},
    )


def _fault(found: Any) -> tuple[str, str] | None:
    """The wrong key and the reason; None if the content is valid."""
    wrong = wrong_format(found, FORMAT, VERSION)
    if wrong is not None:
        return wrong
    for key, shape in _SHAPES.items():
        value = found.get(key)
        if not isinstance(value, str) or shape.fullmatch(value) is None:
            return key, f"its `{key}` is not a value that `crosscheck weave` writes"
    rules, guards = found.get("rules"), found.get("guards")
    if not _is_names(rules):
        return "rules", "its `rules` are not a list of names"
    assert isinstance(rules, list)
    if not isinstance(guards, dict):
        return "guards", "its `guards` is not an object"
    known = set(rules)
    for skill, names in guards.items():
        if not _is_names(names):
            return skill, f"the rules of `{visible(skill)}` are not names"
        unknown = next((each for each in names if each not in known), None)
        if unknown is not None:
            name = visible(unknown[:_LONGEST_NAME])
            return skill, f"`{visible(skill)}` waits for `{name}`, which is not in `rules`"
    return None


def _is_names(found: Any) -> bool:
    return isinstance(found, list) and all(isinstance(each, str) for each in found)


def of_other_skills(guards: Guards, export: Export) -> Diagnostic | None:
    """The finding that guards belong to other skills than the running ones; None if they fit."""
    if guards.digest == export.digest:
        return None
    found = OtherGuards(path=guards.file.path, export=export.file.path, digest=export.digest)
    return found.at(place_of_key(guards.file, "digest"))


# --- while the robot runs -------------------------------------------------------------------------


@dataclass(frozen=True)
class _State:
    """The last reported state of the node: the active rules without an operator's exemption,
    `is_open` if the node passes commands, and the time of the report.
    """

    heard: float
    is_open: bool
    active: frozenset[str]


class ActiveRules:
    """The active rules, according to the messages of their node. Messages may arrive in any thread.
    Times are those of `clock`, in seconds.
    """

    def __init__(self, guards: Guards, clock: Callable[[], float] = time.monotonic) -> None:
        self._guards, self.clock = guards, clock
        self._state: _State | None = None
        self._sign = self._stale = -float("inf")

    def hear_state(self, message: Any) -> None:
        """Handle a `State` message of the node. An unreadable message is ignored."""
        if len(message.active) > _MOST_RULES or len(message.exempted) > _MOST_RULES:
            self._state = None
            return
        active = frozenset(map(str, message.active)) - frozenset(map(str, message.exempted))
        self._state = _State(self.clock(), bool(message.open), active)

    def hear_sign(self) -> None:
        """Record a heartbeat of the node."""
        self._sign = self.clock()

    def lose(self, at: float) -> None:
        """Forget the reported state, because the node was absent for a time."""
        self._stale = at

    def reason_to_wait(self, skill: str) -> str | None:
        """The reason why a skill waits; None if it may start."""
        rules = self._guards.guards.get(skill)
        if not rules:
            return None
        state = self._state
        if state is None or not self._is_valid(state):
            return "the active rules are unknown"
        unknown = sorted(state.active - self._guards.rules)
        if unknown:
            name = visible(unknown[0][:_LONGEST_NAME])
            return f"`{self._guards.node}` has other rules than the guards, such as `{name}`"
        if not state.is_open:
            return f"`{self._guards.node}` does not pass commands yet"
        active = [f"`{each}`" for each in rules if each in state.active]
        if not active:
            return None
        return f"rule {active[0]} is active" if len(active) == 1 else _several(active)

    def _is_valid(self, state: _State) -> bool:
        last_sign = max(self._sign, state.heard)
        return state.heard > self._stale and self.clock() - last_sign <= PATIENCE


def _several(names: list[str]) -> str:
    return f"rules {', '.join(names[:-1])} and {names[-1]} are active"
