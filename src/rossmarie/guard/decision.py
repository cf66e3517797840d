"""The decision of a guard about one action, and its reasons."""

from __future__ import annotations

import struct
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from rossmarie.guard.feedback import FeedbackMeter
from rossmarie.guard.mapping import ArrayMapping
from rossmarie.interpreter import Filter, LimitState
from rossmarie.ir import (
    NEVER_NS,
    CommandPart,
    FieldBounds,
    Machine,
    TaskCommandKind,
    TaskState,
    Verdict,
    Wiring,
    explain,
)
from rossmarie.ir.reactions import (
    Call,
    CancelGoal,
    Diagnose,
    Effect,
    Hook,
    Limit,
    Log,
    Publish,
    Reset,
    Retrace,
    Scale,
    SendGoal,
    SetParameter,
    SwitchControllers,
)
from rossmarie.native import CHANGED, CLOSED, REFUSED

Array = NDArray[Any]


Before: TypeAlias = "tuple[int, bytes] | None"
"""The instant and the facts of the previous observation; None at the first observation."""


def active_in(note: bytes, rules: int) -> NDArray[np.bool_]:
    """A mask of the active rules, from the facts after a step."""
    bits = np.frombuffer(note, np.uint8, offset=1, count=(rules + 7) // 8)
    return np.unpackbits(bits, count=rules, bitorder="little").astype(np.bool_)


def margins_in(note: bytes, meter: FeedbackMeter) -> NDArray[np.float64]:
    """The declared margins, each in its unit, from the facts after a step."""
    first = 1 + (max(1, meter.rules) + 7) // 8
    declared = np.frombuffer(note, np.uint8, 8 * meter.declared_margins, first)
    return meter.margins(declared.view(np.float64))


def feedback_between(
    meter: FeedbackMeter, before: tuple[int, bytes], after: tuple[int, bytes]
) -> NDArray[np.float64]:
    """The feedback of each rule from one observation to the next, of shape (rules,)."""
    was, is_ = (active_in(note, meter.rules) for _, note in (before, after))
    return meter.between(was, is_, after[0] - before[0])


@dataclass(frozen=True)
class Request:
    """A request of rules beside the action. `kind` tells whether its `effect` starts or stops, or
    whether the effect must be given up because another rule overrules it or because it has failed.
    `task` is its number. The program that starts a task reports the task's end with `Guard.report`.
    With `TaskCommandKind.RETRACE`, send `pose`: x, y and z in m, and with an orientation its
    quaternion (x, y, z, w).
    """

    kind: TaskCommandKind
    rule: str
    action: str
    effect: Effect
    task: int
    pose: tuple[float, ...] = ()


@dataclass(frozen=True)
class Reasons:
    """The basis of decisions: the rules, the mapping of arrays to fields, and the verdicts that
    activated rules.
    """

    machine: Machine
    meter: FeedbackMeter
    mapping: ArrayMapping
    wiring: Wiring
    causes: Mapping[int, Verdict]


class Decision:
    """A permitted action, and the reasons. All other data are computed on demand."""

    __slots__ = (
        "_at_ns",
        "_before",
        "_earlier",
        "_given",
        "_note",
        "_reasons",
        "action",
        "requests",
    )

    def __init__(
        self,
        at_ns: int,
        action: Array,
        note: bytes,
        reasons: Reasons,
        before: Before,
        earlier: NDArray[np.float64] | None = None,
        given: Array | None = None,
        requests: tuple[Request, ...] = (),
    ) -> None:
        self._at_ns = at_ns
        self._before = before
        self._earlier = earlier
        self.action = action
        """The action to execute."""
        self._note = note
        self._reasons = reasons
        self._given = given
        self.requests = requests
        """All requests of rules beside the action, in order."""

    @property
    def changed(self) -> bool:
        """True if the action differs from the proposed action."""
        return bool(self._note[0] & CHANGED)

    @property
    def refused(self) -> bool:
        """True if the proposed action contained a number that is not finite."""
        return bool(self._note[0] & REFUSED)

    @property
    def active(self) -> tuple[str, ...]:
        """The rules that are active."""
        return tuple(self._reasons.machine.rules[rule].name for rule in self._active())

    @property
    def feedback(self) -> NDArray[np.float64]:
        """The feedback of each rule to a learner since the observation of the previous decision, of
        shape (rules,); 0 at the first observation.
        """
        meter = self._reasons.meter
        if self._before is None:
            return np.zeros(meter.rules)
        last = feedback_between(meter, self._before, (self._at_ns, self._note))
        return last if self._earlier is None else self._earlier + last

    @property
    def margin(self) -> NDArray[np.float64]:
        """The distances of conditions to the point where their value changes, of shape (margins,),
        in the order of `Guard.rules_with_margin`, each in the unit that its rule declares. A margin
        is positive while the condition is false, negative while it is true, and NaN while it is
        unknown.
        """
        return margins_in(self._note, self._reasons.meter)

    @property
    def changed_by(self) -> tuple[str, ...]:
        """The rules that changed the action, in their order."""
        found = {rule for _, rules in self._changes() for rule in rules}
        return tuple(rule.name for rule in self._reasons.machine.rules if rule.name in found)

    def why(self) -> str:
        """The active rules with their causes, and each change with its rules, one per line."""
        return "\n".join(self._lines()) or "no rule is active"

    def __repr__(self) -> str:
        changed = f", changed by {', '.join(self.changed_by)}" if self.changed else ""
        return f"<Decision at {self._at_ns} ns: {self.action}{changed}>"

    # --- reasons -----------------------------------------------------------------------------

    def _active(self) -> list[int]:
        rules = range(len(self._reasons.machine.rules))
        return [rule for rule in rules if self._note[1 + rule // 8] >> rule % 8 & 1]

    def _lines(self) -> Iterator[str]:
        machine = self._reasons.machine
        if self._note[0] & CLOSED:
            yield "no action passes before every input with a timeout has arrived"
        if self.refused:
            yield "the wanted action has a number that is not finite: its command becomes 0"
        for rule in self._active():
            cause = self._reasons.causes.get(rule)
            because = f": {explain(machine, cause).line()}" if cause else ""
            yield f"{machine.rules[rule].name} is active{because}"
        for words, rules in self._changes():
            yield words + (f", by {', '.join(rules)}" if rules else "")

    def _changes(self) -> Iterator[tuple[str, list[str]]]:
        """Each changed number, in words, and the rules that alone would change it."""
        if self._given is None:
            return
        for part in self._reasons.wiring.commands:
            for place in part.part.places:
                before, after = self._given[place], self.action[place]
                if before != after:
                    name = self._reasons.mapping.name(part)
                    words = f"action[{place}] ({name}): {before:g} became {after:g}"
                    yield words, self._changing(part, float(before))

    def _changing(self, part: CommandPart, given: float) -> list[str]:
        machine = self._reasons.machine
        number = given * part.part.scale + part.part.offset
        return [
            machine.rules[rule].name
            for rule, plan in enumerate(machine.reactions.plans)
            if any(self._changes_it(task, part, number) for task in plan.tasks)
        ]

    def _changes_it(self, task: int, part: CommandPart, number: float) -> bool:
        """Say whether one task alone would change a number of a finite command."""
        if self.refused:
            return False
        effect = self._reasons.machine.reactions.tasks[task].effect
        match effect:
            case Limit() | Scale() if effect.topic == part.command:
                return self._bounds(task, part).of(number) != number
            case Publish() if effect.command == part.command:
                begun = self._state(task) is TaskState.DONE and self._since_ns(task) == self._at_ns
                return begun or self._state(task) is TaskState.HOLDING
            case (
                Limit() | Scale() | Publish() | Retrace() | Call() | SetParameter()
                | SwitchControllers() | SendGoal() | CancelGoal() | Log() | Diagnose() | Hook()
                | Reset()
            ):  # fmt: skip
                return False

    def _bounds(self, task: int, part: CommandPart) -> FieldBounds:
        is_on, since_ns = self._state(task) is TaskState.HOLDING, self._since_ns(task)
        force = LimitState(is_on, None if is_on or since_ns == NEVER_NS else since_ns)
        bounding = Filter.of(self._reasons.machine.reactions, task, force)
        return bounding.bounds(self._at_ns, part.command)[part.field]

    def _since_ns(self, task: int) -> int:
        tasks = len(self._reasons.machine.reactions.tasks)
        first = len(self._note) - 8 * tasks
        since_ns: int
        (since_ns,) = struct.unpack_from("=q", self._note, first + 8 * task)
        return since_ns

    def _state(self, task: int) -> TaskState:
        tasks = len(self._reasons.machine.reactions.tasks)
        return TaskState(self._note[len(self._note) - 9 * tasks + task])
