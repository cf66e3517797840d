"""The step from a model of the solver to a witness: a draft with variable numbers.

A draft stores an orientation as angles, and all other values as the numbers of the messages.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import z3

from rossmarie import ir
from rossmarie.analysis.terms import number_of
from rossmarie.analysis.trace import Leg, LegMoment, SymbolicTrace
from rossmarie.analysis.witness import Sending, Witness
from rossmarie.ir import ChannelValues, Machine
from rossmarie.ir.carried import raw_of
from rossmarie.units import DIMENSIONLESS, Unit, parse_unit

_ANGLES = (ir.Function.ROLL, ir.Function.PITCH, ir.Function.YAW)


@dataclass(frozen=True)
class Knob:
    """A variable number in a leg of a draft: the number of a slot, an element (`cell`), or an angle
    of the orientation in four slots. `unit` is the unit that the user sees.
    """

    slots: tuple[int, ...]
    array: int | None
    cell: int
    angle: ir.AnyFunction | None
    unit: Unit


@dataclass(frozen=True)
class DraftLeg:
    """The messages of one leg: knobs with their values in SI. `shakes` are the slots that
    oscillate, with their amplitudes.
    """

    channels: tuple[int, ...]
    values: Mapping[Knob, float]
    shakes: Mapping[int, float] = field(default_factory=dict)
    length_ns: int = 0


@dataclass(frozen=True)
class Draft:
    """A sequence of legs."""

    legs: tuple[DraftLeg, ...]
    period_ns: int
    is_calm: bool
    """True if all sensors must work, and do."""

    def with_value(self, leg: int, knob: Knob, value: float) -> Draft:
        """Return the same draft with another value for one knob."""
        old = self.legs[leg]
        turned = replace(old, values={**old.values, knob: value})
        return replace(self, legs=(*self.legs[:leg], turned, *self.legs[leg + 1 :]))

    def with_leg(self, leg: int, new: DraftLeg | None) -> Draft:
        """Return the same draft with one leg replaced, or removed."""
        put = () if new is None else (new,)
        return replace(self, legs=(*self.legs[:leg], *put, *self.legs[leg + 1 :]))


def drafted(trace: SymbolicTrace, model: z3.ModelRef, *, is_calm: bool) -> Draft:
    """Read a model of a trace."""
    machine = trace.asked.machine
    legs = []
    for number, leg in enumerate(trace.legs):
        moments = trace.moments[2 * number : 2 * number + 2]
        sending = [c for c, sends in leg.sends.items() if _is_true(model, sends)]
        legs.append(
            DraftLeg(
                tuple(sending),
                dict(_values(machine, leg, moments, sending, model)),
                dict(_shakes(machine, leg, model)),
                int(number_of(model.eval(leg.length_ns, model_completion=True))),
            )
        )
    return Draft(tuple(legs), trace.times.period_ns, is_calm)


def _is_true(model: z3.ModelRef, term: z3.BoolRef) -> bool:
    return bool(z3.is_true(model.eval(term, model_completion=True)))


def _values(
    machine: Machine,
    leg: Leg,
    moments: Sequence[LegMoment],
    sending: Sequence[int],
    model: z3.ModelRef,
) -> Iterator[tuple[Knob, float]]:
    def value(term: z3.ExprRef) -> float:
        return number_of(model.eval(term, model_completion=True))

    turned: set[int] = set()
    for index, slots in _orientations(machine):
        channel = machine.inputs[machine.slots[slots[0]].input].channel
        asked = [moment for moment in moments if index in moment.known_signals]
        if channel not in sending or not asked:
            continue
        is_known = all(_is_true(model, leg.slots[slot].known) for slot in slots)
        if is_known:
            node, signal = machine.signals[index].node, machine.signals[index]
            assert isinstance(node, ir.Apply)
            knob = Knob(slots, None, 0, node.function, _unit_of(signal))
            yield knob, value(asked[-1].signal(index).value)
            turned |= set(slots)
    for slot, number in leg.slots.items():
        is_sent = machine.inputs[machine.slots[slot].input].channel in sending
        if is_sent and slot not in turned and _is_true(model, number.known):
            yield _slot_knob(machine, slot), value(number.value)
    for array, cells in leg.cells.items():
        if machine.inputs[machine.arrays[array].input].channel in sending:
            unit = _shown_in(machine, ir.Element(array))
            for i, cell in enumerate(cells):
                if _is_true(model, cell.is_there):
                    knob = Knob((), array, i, None, unit)
                    yield knob, value(cell.number.value)


def _orientations(machine: Machine) -> Iterator[tuple[int, tuple[int, ...]]]:
    """Each orientation in a message: the angles that rules compute from it, and its slots."""
    for index, signal in enumerate(machine.signals):
        node = signal.node
        if isinstance(node, ir.Apply) and node.function in _ANGLES:
            reads = [machine.signals[operand].node for operand in node.operands]
            slots = tuple(read.slot for read in reads if isinstance(read, ir.Read))
            if len(slots) == len(set(slots)) == len(reads):
                yield index, slots


def _slot_knob(machine: Machine, slot: int) -> Knob:
    return Knob((slot,), None, 0, None, _shown_in(machine, ir.Read(slot)))


def _shown_in(machine: Machine, node: ir.SignalNode) -> Unit:
    found = next((signal for signal in machine.signals if signal.node == node), None)
    return DIMENSIONLESS if found is None else _unit_of(found)


def _unit_of(signal: ir.Signal) -> Unit:
    return parse_unit(signal.unit) if signal.unit else DIMENSIONLESS


def _shakes(machine: Machine, leg: Leg, model: z3.ModelRef) -> Iterator[tuple[int, float]]:
    for proposition, shakes in leg.shakes.items():
        node = machine.propositions[proposition].node
        assert isinstance(node, ir.Oscillates)
        read = machine.signals[node.signal].node
        if _is_true(model, shakes) and isinstance(read, ir.Read):
            yield read.slot, 2.0 * node.swing + 1.0


# --- events ----------------------------------------------------------------------------------


def witness_of(machine: Machine, draft: Draft) -> Witness:
    """The messages of a draft: on each leg one message at the beginning, then one per period, and
    the last message at the end.
    """
    events: list[Sending] = []
    start_ns = end_ns = 0
    for leg in draft.legs:
        instants = [*range(start_ns, start_ns + leg.length_ns, draft.period_ns)]
        instants.append(start_ns + leg.length_ns)
        for count, at_ns in enumerate(dict.fromkeys(instants)):
            if leg.channels:
                swing = count % 2 if leg.shakes else 0
                messages = {c: _message(machine, leg, c, swing) for c in leg.channels}
                events.append(Sending(at_ns, messages))
        end_ns = start_ns + leg.length_ns
        start_ns = end_ns + draft.period_ns
    return Witness(tuple(events), end_ns, draft.is_calm)


def _message(machine: Machine, leg: DraftLeg, channel: int, swing: int) -> ChannelValues:
    slots: dict[int, float] = {}
    arrays: dict[int, list[float]] = {}
    angles: dict[tuple[int, ...], dict[ir.AnyFunction, float]] = {}
    for knob, value in leg.values.items():
        if knob.angle is not None:
            angles.setdefault(knob.slots, {})[knob.angle] = value
        elif knob.array is not None:
            if machine.inputs[machine.arrays[knob.array].input].channel == channel:
                arrays.setdefault(knob.array, []).append(raw_of(machine.arrays[knob.array], value))
        else:
            (slot,) = knob.slots
            slots[slot] = value + swing * leg.shakes.get(slot, 0.0)
    for group, given in angles.items():
        slots |= dict(zip(group, quaternion(given), strict=True))
    own = {
        slot: raw_of(machine.slots[slot], value)
        for slot, value in slots.items()
        if machine.inputs[machine.slots[slot].input].channel == channel
    }
    no_elements: dict[int, list[float]] = {
        index: []
        for index, array in enumerate(machine.arrays)
        if array.list is not None and machine.inputs[array.input].channel == channel
    }
    return ChannelValues(own, arrays | no_elements)


def quaternion(angles: Mapping[ir.AnyFunction, float]) -> tuple[float, float, float, float]:
    """The orientation x, y, z, w with these angles in radians. Missing angles are 0."""
    roll, pitch, yaw = (angles.get(angle, 0.0) / 2.0 for angle in _ANGLES)
    cr, sr, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )
