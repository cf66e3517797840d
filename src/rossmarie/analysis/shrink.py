"""Short witnesses: fewer legs, fewer messages, round numbers, and no time after the end."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from rossmarie.analysis.draft import Draft, DraftLeg, Knob, witness_of
from rossmarie.analysis.quantities import is_quantity
from rossmarie.analysis.witness import Predicate, View, Witness, views
from rossmarie.ir import (
    AgeReaches,
    Count,
    FieldKind,
    Fold,
    Held,
    Machine,
    Read,
    all_channels,
    supports,
)
from rossmarie.ir.carried import carries

_MOST_REPLAYS = 80
_MOST_MESSAGES = 400
"""The most messages in a witness that is replayed repeatedly."""


class Replays:
    """Judges drafts: the interpreter replays each draft, and checks whether the draft shows a
    predicate. The number of replays is limited.
    """

    def __init__(self, machine: Machine, predicate: Predicate, asked: Sequence[int]) -> None:
        self._machine = machine
        self._predicate = predicate
        self._asked = asked
        self._left = _MOST_REPLAYS
        self._channels = [all_channels(machine, support) for support in supports(machine).signals]

    def show(self, draft: Draft) -> Witness | None:
        """The witness up to the instant at which it shows the predicate; None if it does not show
        the predicate.
        """
        if self._left <= 0 or _messages(draft) > _MOST_MESSAGES * 20:
            return None
        self._left -= 1 + _messages(draft) // _MOST_MESSAGES
        witness = witness_of(self._machine, draft)
        seen: list[View] = []
        for view in views(self._machine, witness, self._asked):
            seen.append(view)
            if draft.is_calm and self._has_gap(draft, view):
                return None
            if self._predicate(seen):
                return _until(witness, view)
        return None

    def _has_gap(self, draft: Draft, view: View) -> bool:
        """Say whether a value that the draft sends is unknown."""
        channels = {channel for leg in draft.legs for channel in leg.channels}
        return any(
            math.isnan(view.signals[index]) and self._channels[index] <= channels
            for index, signal in enumerate(self._machine.signals)
            if isinstance(signal.node, Read | Fold | Count)
            and not (isinstance(signal.node, Read) and is_quantity(self._machine, signal.node.slot))
        )


def _messages(draft: Draft) -> int:
    return sum(leg.length_ns // draft.period_ns + 2 for leg in draft.legs)


def _until(witness: Witness, view: View) -> Witness:
    events = tuple(event for event in witness.events if event.at_ns <= view.at_ns)
    return Witness(events, view.at_ns, witness.is_calm)


def shortened(machine: Machine, draft: Draft, replays: Replays) -> Witness | None:
    """The shortest witness that is found around a draft; None if the draft is not confirmed."""
    best = replays.show(draft)
    if best is None:
        return None
    changed = True
    while changed:
        changed = False
        for simpler in _simpler(machine, draft):
            witness = replays.show(simpler)
            if witness is not None:
                best, draft, changed = witness, simpler, True
                break
    return best


def _simpler(machine: Machine, draft: Draft) -> Iterator[Draft]:
    """Simpler drafts, the greatest simplification first."""
    for number, leg in enumerate(draft.legs):
        if len(draft.legs) > 1:
            yield draft.with_leg(number, None)
        for channel in () if draft.is_calm else leg.channels:
            yield draft.with_leg(number, _without(machine, leg, channel))
        for length_ns in _lengths(machine):
            if length_ns < leg.length_ns:
                yield draft.with_leg(number, replace(leg, length_ns=length_ns))
        if leg.shakes:
            yield draft.with_leg(number, replace(leg, shakes={}))
    if draft.period_ns * 1000 < max(leg.length_ns for leg in draft.legs):
        yield replace(draft, period_ns=draft.period_ns * 10)
    longest = max(leg.length_ns for leg in draft.legs)
    if longest > draft.period_ns:
        yield replace(draft, period_ns=longest)
    for number, leg in enumerate(draft.legs):
        for knob, value in leg.values.items():
            for rounder in _rounder(machine, knob, value):
                yield draft.with_value(number, knob, rounder)


def _lengths(machine: Machine) -> list[int]:
    """The lengths of a leg in ns, the best first: no time at all, or a duration in the rules."""
    durations = {
        node.duration_ns
        for proposition in machine.propositions
        if isinstance(node := proposition.node, Held)
    }
    ages = {
        node.age_ns
        for proposition in machine.propositions
        if isinstance(node := proposition.node, AgeReaches)
    }
    return sorted({0} | durations | ages)


def _without(machine: Machine, leg: DraftLeg, channel: int) -> DraftLeg:
    """A leg without a channel."""
    kept = {knob: value for knob, value in leg.values.items() if _channel(machine, knob) != channel}
    return replace(leg, channels=tuple(c for c in leg.channels if c != channel), values=kept)


def _channel(machine: Machine, knob: Knob) -> int:
    source = machine.slots[knob.slots[0]] if knob.array is None else machine.arrays[knob.array]
    return machine.inputs[source.input].channel


def _rounder(machine: Machine, knob: Knob, value: float) -> Iterator[float]:
    """Rounder values near a value, in the unit that the user sees, the roundest first."""
    is_slot = knob.array is None and knob.angle is None
    if is_slot and machine.slots[knob.slots[0]].kind is not FieldKind.REAL:
        return
    shown_value = knob.unit.from_si(value)
    source = machine.slots[knob.slots[0]] if knob.array is None else machine.arrays[knob.array]
    for text in _round_numbers(shown_value):
        turned = knob.unit.to_si(text)
        if cost(text) < cost(shown_value) and carries(source, turned):
            yield turned


def cost(number: float) -> tuple[int, float]:
    """The cost of a number: its count of digits. Among equal counts, numbers that end in 5 or 0 are
    rounder.
    """
    digits = f"{abs(number):.12e}".partition("e")[0].replace(".", "").rstrip("0")
    return (len(digits), float(digits[-1:] not in ("5", "")))


def _round_numbers(number: float) -> Iterator[float]:
    yield 0.0
    if number == 0.0 or not math.isfinite(number):
        return
    exponent = math.floor(math.log10(abs(number)))
    for power in range(exponent, exponent - 4, -1):
        for step in (10.0**power, 5.0 * 10.0 ** (power - 1)):
            for whole in (math.floor(number / step), math.ceil(number / step)):
                yield float(f"{whole * step:.12g}")
