"""Random machines in which everything is asked of elements beside numbers (S74): an array and a
list, each with numbers of its own message and of others, which expire at other times.
"""

from __future__ import annotations

import math

from hypothesis import strategies as st

from rossmarie import ir
from support.growing import TICK, Growing, durations
from support.machines import Advance, Case, Step, Update

_limits = st.sampled_from((-1.0, 0.0, 0.5, 1.0))
_LATE = st.sampled_from((None, 6 * TICK))
_SOON = st.sampled_from((None, TICK, 2 * TICK, 3 * TICK))


@st.composite
def machines_beside(draw: st.DrawFn) -> ir.Machine:
    """Each rule looks at one query to the elements, or at one result of them."""
    growing = Growing(draw)
    draft = growing.draft
    array_input, list_input = (draft.input(draft.channel(), draw(_LATE)) for _ in "al")
    others = [draft.input(draft.channel(), draw(_SOON)) for _ in "xy"]
    array = draft.array(array_input)
    columns = draft.list_of(list_input, 2)
    elements = [draft.signal(ir.Element(array))]
    column = draft.column(columns)
    elements.append(draft.signal(ir.Element(column)))
    numbers = [draft.signal(ir.Read(draft.slot(used))) for used in (array_input, *others)]
    numbers.append(draft.apply(ir.Function.ADD, *draw(st.permutations(numbers))[:2]))
    for _ in range(draw(st.integers(1, 3))):
        proposition = _query(draw, growing, elements, numbers)
        if draw(st.booleans()):
            proposition = draft.proposition(ir.Held(proposition, draw(durations)))
        draft.rule(proposition)
    return draft.machine("beside")


def _query(draw: st.DrawFn, growing: Growing, elements: list[int], numbers: list[int]) -> int:
    draft = growing.draft
    element, number = draw(st.sampled_from(elements)), draw(st.sampled_from(numbers))
    comparison = draw(st.sampled_from(ir.Comparison))
    below = draft.proposition(ir.Compare(comparison, element, number))
    if draw(st.booleans()):
        limit = draft.constant(draw(_limits))
        own = draft.proposition(ir.Compare(ir.Comparison.LESS, element, limit))
        below = draft.proposition(ir.Or((below, own)))
    match draw(st.sampled_from(("quantified", "count", "fold", "rate"))):
        case "quantified":
            return draft.proposition(ir.Quantified(draw(st.sampled_from(ir.Quantifier)), below))
        case "count":
            return draft.above(draft.signal(ir.Count(below)), 0.0)
        case "fold":
            return draft.above(_least(draw, growing, element, number), draw(_limits))
        case _:  # open: "rate", the last of them
            sampled = ir.Sampled(ir.Sampling.RATE, _least(draw, growing, element, number))
            return draft.above(draft.signal(sampled), draw(_limits))


def _least(draw: st.DrawFn, growing: Growing, element: int, number: int) -> int:
    function = draw(st.sampled_from((ir.Function.SUBTRACT, ir.Function.MAXIMUM)))
    apart = growing.draft.apply(function, element, number)
    return growing.draft.signal(ir.Fold(draw(st.sampled_from(ir.Folding)), apart))


@st.composite
def cases_beside(draw: st.DrawFn) -> Case:
    """Such a machine and what happens to it: first everything arrives, and is known."""
    machine = draw(machines_beside())
    at_ns = 0
    steps: list[Step] = [Update(0, {channel: _sent(draw, machine, channel) for channel in _ALL})]
    for _ in range(draw(st.integers(2, 14))):
        at_ns += draw(st.sampled_from((0, 1, 1, 2, 3, 5))) * TICK
        channels = draw(st.sampled_from(((), (0,), (1,), (0, 2), (1, 3), (2,), (3,), (0, 1, 2))))
        messages = {channel: _sent(draw, machine, channel) for channel in channels}
        steps.append(Update(at_ns, messages) if channels else Advance(at_ns))
    return machine, steps


_ALL = range(4)


def _sent(draw: st.DrawFn, machine: ir.Machine, channel: int) -> ir.ChannelValues:
    """A message with all that it may have, and now and then a number that is not known."""
    numbers = st.sampled_from((0.0, 1.0, 2.0, 3.0, 0.5, -1.0, math.inf, math.nan))
    small = st.sampled_from((0.0, 0.5, 1.0, 2.0, 3.0))
    slots = {
        index: draw(st.one_of(small, small, numbers))
        for index, slot in enumerate(machine.slots)
        if machine.inputs[slot.input].channel == channel
    }
    arrays = {
        index: draw(st.lists(st.one_of(small, small, numbers), max_size=2))
        for index, array in enumerate(machine.arrays)
        if machine.inputs[array.input].channel == channel
    }
    return ir.ChannelValues(slots, arrays)
