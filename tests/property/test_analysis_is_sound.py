"""The analysis allows every behaviour of random machines on random traces. A behaviour that the
analysis proves impossible never happens.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial

import z3
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.analysis.activity import is_cleared, together
from rossmarie.analysis.encoding import Questioned
from rossmarie.analysis.failures import losses
from rossmarie.analysis.holding import Kept, is_ended, is_within
from rossmarie.analysis.implied import needs
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.latches import LATCHED, RESETTING, Release
from rossmarie.analysis.rates import never_at_rate
from rossmarie.analysis.solver import Satisfiability, ask
from rossmarie.analysis.state import ArbitraryState
from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, TruthValue
from rossmarie.ir.reactions import CommandField, CommandTopic
from support.drafts import NOWHERE, Draft
from support.growing import NUMBERS, TICK, Growing, durations, scales, timeouts
from support.machines import (
    Case,
    cases,
    channel_values,
    machines,
    take,
    traces,
)

numbers = st.sampled_from(NUMBERS)

unhurried = settings(
    deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much]
)


def whole_propositions(machine: ir.Machine) -> tuple[int, ...]:
    arrays = ir.element_arrays(machine).propositions
    return tuple(index for index, array in enumerate(arrays) if array is None)


def watching(machine: ir.Machine) -> Interpreter:
    """A monitor whose watches are all propositions."""
    return Interpreter(replace(machine, watches=whole_propositions(machine)))


def values_of(machine: ir.Machine, monitor: Interpreter) -> dict[int, TruthValue]:
    """The truth values of all propositions."""
    return dict(zip(whole_propositions(machine), monitor.watches, strict=True))


def is_settled(machine: ir.Machine, values: Mapping[int, TruthValue], *roots: int) -> bool:
    """Say whether each `for` with a true condition has matured, for all propositions or the support
    of some.
    """
    below = {
        proposition for root in roots for proposition in ir.reachable_propositions(machine, root)
    } or values
    held = [
        (proposition, node.operand)
        for proposition in below
        if isinstance(node := machine.propositions[proposition].node, ir.Held)
    ]
    return all(
        values[proposition] is TruthValue.TRUE
        for proposition, operand in held
        if values[operand] is TruthValue.TRUE
    )


def evaluations(case: Case) -> list[dict[int, TruthValue]]:
    """The values of all propositions right after each event, each combination once."""
    machine, trace = case
    monitor = watching(machine)
    seen = []
    for step in trace:
        take(monitor, step)
        seen.append(monitor.watches)
    return [
        dict(zip(whole_propositions(machine), values, strict=True))
        for values in dict.fromkeys(seen)
    ]


@unhurried
@given(cases())
def test_every_evaluation_is_a_state(case: Case) -> None:
    machine, _ = case
    for values in evaluations(case)[:6]:
        inquiry = Inquiry(machine)
        for settled in (False, True) if is_settled(machine, values) else (False,):
            state = ArbitraryState(inquiry.asked, settled=settled)
            predicate = z3.And(
                [
                    state.proposition(proposition).is_value(values[proposition])
                    for proposition in values
                ]
            )
            orders = list(inquiry.orders(state))
            answer = ask([*state.facts, *orders], predicate)
            assert answer.outcome is not Satisfiability.IMPOSSIBLE, (values, state.facts)


@unhurried
@given(machines(max_nodes=8), st.data())
def test_rules_that_are_never_together_never_are(machine: ir.Machine, data: st.DataObject) -> None:
    pairs = [(one, two) for one in range(len(machine.rules)) for two in range(one)]
    inquiry = Inquiry(machine)
    apart = [
        pair
        for pair in pairs
        if inquiry.is_impossible(partial(together, one=pair[0], other=pair[1]))
    ]
    lone = [
        (one, two) for pair in pairs for one, two in (pair, pair[::-1]) if needs(inquiry, one, two)
    ]
    assume(apart or lone)
    for _ in range(4):
        monitor = Interpreter(machine)
        for step in data.draw(traces(machine)):
            take(monitor, step)
            active = monitor.active
            assert [pair for pair in apart if active[pair[0]] and active[pair[1]]] == []
            assert [pair for pair in lone if active[pair[0]] and not active[pair[1]]] == []


@unhurried
@given(machines(max_nodes=8), st.data())
def test_a_rule_that_nothing_clears_is_never_cleared(
    machine: ir.Machine, data: st.DataObject
) -> None:
    inquiry = Inquiry(machine)
    stuck = [
        rule
        for rule, declared in enumerate(machine.rules)
        if declared.release is not None and inquiry.is_impossible(partial(is_cleared, rule=rule))
    ]
    assume(stuck)
    for _ in range(4):
        monitor = Interpreter(machine)
        was_active: set[int] = set()
        for step in data.draw(traces(machine)):
            take(monitor, step)
            assert all(monitor.active[rule] for rule in was_active)
            was_active |= {rule for rule in stuck if monitor.active[rule]}


@unhurried
@given(machines(max_nodes=8), st.data())
def test_a_latch_that_no_reset_releases_is_not_released(
    machine: ir.Machine, data: st.DataObject
) -> None:
    everywhere = range(len(machine.rules))
    latched = [rule for rule in everywhere if machine.rules[rule].release is None]
    pairs = [(one, two) for two in latched for one in everywhere]
    parts = [Inquiry(machine).about(*pair) for pair in pairs]
    kept = [
        part.machine
        for part in parts
        if part.is_impossible(Release(part.machine, is_at_once=False).in_state)
    ]
    assume(kept)
    part = data.draw(st.sampled_from(kept))
    condition = part.rules[LATCHED].condition
    for _ in range(4):
        monitor = watching(part)
        for step in data.draw(traces(part)):
            take(monitor, step)
            is_over = values_of(part, monitor)[condition] is TruthValue.FALSE
            both = monitor.active[RESETTING] and monitor.active[LATCHED]
            assert not (both and is_over)


@st.composite
def forgiving(draw: st.DrawFn) -> ir.Machine:
    """A machine with a rule whose condition asks, among others, that an input is not too old."""
    growing = Growing(draw)
    growing.inputs()
    for _ in range(draw(st.integers(1, 4))):
        growing.signal()
        growing.proposition()
    draft = growing.draft
    used = draw(st.integers(0, len(draft.inputs) - 1))
    aged = draft.proposition(ir.AgeReaches(used, draw(st.integers(1, 4)) * TICK))
    one, other = growing.one_of(growing.propositions), growing.one_of(growing.propositions)
    young = draft.proposition(ir.Not(aged))
    either = draft.proposition(ir.Or((one, other)))
    nodes: tuple[ir.PropositionNode, ...] = (
        ir.And((young, one)),
        ir.And((either, young)),
        ir.Not(draft.proposition(ir.Or((aged, one)))),
        ir.Held(draft.proposition(ir.And((young, one, other))), 2 * TICK),
        ir.Or((draft.proposition(ir.And((young, one))), other)),
    )
    draft.rule(draft.proposition(draw(st.sampled_from(nodes))))
    return draft.machine("forgiving")


@unhurried
@given(forgiving(), st.data())
def test_the_loss_of_an_input_does_nothing_to_rules_of_which_that_is_said(
    machine: ir.Machine, data: st.DataObject
) -> None:
    found = [
        loss
        for loss in losses(Inquiry(machine))
        if loss.after_ns is not None and loss.input in machine.rules[0].inputs and not loss.effects
    ]
    assume(found)
    loss = data.draw(st.sampled_from(found))
    stale = machine.inputs[loss.input].channel
    monitor = watching(machine)
    monitor.update(0, {stale: data.draw(channel_values(machine, stale))})
    others = [channel for channel in range(len(machine.channels)) if channel != stale]
    calm = 0
    for tick in range(1, 24):
        sent = {channel: data.draw(channel_values(machine, channel)) for channel in others}
        monitor.update(tick * TICK, sent) if sent else monitor.advance(tick * TICK)
        values = values_of(machine, monitor)
        is_over = tick * TICK >= (loss.after_ns or 0) and is_settled(machine, values)
        if is_over and _are_known(machine, monitor, stale):
            calm += 1
            condition = values[machine.rules[0].condition]
            assert condition in (TruthValue.FALSE, TruthValue.UNKNOWN)
    assume(calm)


def _are_known(machine: ir.Machine, monitor: Interpreter, stale: int) -> bool:
    """Say whether all numbers in the messages of the rule are known, except one channel."""
    slots = ir.supports(machine).propositions[machine.rules[0].condition].slots
    reads = {
        signal.node.slot: monitor.signals[index]
        for index, signal in enumerate(machine.signals)
        if isinstance(signal.node, ir.Read)
    }
    channels = {slot: machine.inputs[machine.slots[slot].input].channel for slot in slots}
    return not any(channels[slot] != stale and math.isnan(reads[slot]) for slot in slots)


@st.composite
def conditions(draw: st.DrawFn, draft: Draft, x: int, y: int) -> int:
    """A condition on two numbers."""
    above = draft.above(x, draw(st.sampled_from((-0.5, 0.0, 0.5))))
    other = draft.above(y, draw(numbers))
    below = draft.proposition(ir.Not(above))
    nodes: tuple[ir.PropositionNode, ...] = (
        draft.propositions[above].node,
        draft.propositions[below].node,
        ir.And((below, other)),
        ir.Or((above, other)),
        ir.Held(above, draw(durations)),
        ir.And((above, draft.proposition(ir.Held(other, draw(durations))))),
    )
    return draft.proposition(draw(st.sampled_from(nodes)))


COMMANDED = replace(
    ir.NO_REACTIONS,
    commands=(
        CommandTopic(
            "/topic_0", "std_msgs/Float64", (CommandField(("slot_0",), False, ""),), NOWHERE
        ),
    ),
)
"""The first number of the first topic is one of a command."""


@unhurried
@given(st.data())
def test_a_limit_that_holds_its_rule_does(data: st.DataObject) -> None:
    draft = Draft()
    timeout_ns = data.draw(timeouts)
    x, y = draft.read(timeout_ns), draft.read()
    condition = data.draw(conditions(draft, x, y))
    calm = draft.proposition(ir.Held(draft.proposition(ir.Not(condition)), data.draw(durations)))
    moving = draft.above(x, data.draw(st.sampled_from((0.5, 1.0))))
    rule = draft.rules[draft.rule(condition, data.draw(st.sampled_from((None, calm, moving))))]
    low, high = data.draw(st.sampled_from(((0.0, 1.0), (-1.0, 0.0), (0.0, 0.5), (-0.5, 0.0))))
    machine = replace(draft.machine(), reactions=COMMANDED)
    kept = [Kept(0, 0, 0, low, high)]

    def predicate(state: ArbitraryState) -> z3.BoolRef:
        return z3.And(is_ended(state, 0), is_within(state, kept))

    assume(Inquiry(machine).is_impossible(predicate, settled=True))
    monitor = watching(machine)
    was_active = False
    inside = st.one_of(st.sampled_from((low, high)), st.floats(low, high))
    for tick in range(40):
        sent = {1: ChannelValues({1: data.draw(numbers)})}
        if tick == 0 or data.draw(st.booleans()):
            sent[0] = ChannelValues({0: data.draw(inside)})
        monitor.update(tick * TICK, sent)
        roots = (rule.condition, rule.release or 0)
        if is_settled(machine, values_of(machine, monitor), *roots):
            assert monitor.active[0] or not was_active
        was_active = monitor.active[0]


@unhurried
@given(st.data())
def test_what_is_never_true_at_a_rate_never_is(data: st.DataObject) -> None:
    draft = Draft()
    x, y = draft.read(data.draw(timeouts)), draft.read()
    condition = data.draw(conditions(draft, x, y))
    young = draft.proposition(ir.Not(draft.proposition(ir.AgeReaches(0, data.draw(durations)))))
    both = draft.proposition(ir.And((condition, young)))
    draft.proposition(ir.Held(data.draw(st.sampled_from((condition, both))), data.draw(durations)))
    draft.proposition(ir.Oscillates(x, data.draw(st.integers(1, 4)), data.draw(durations), 0.0))
    draft.above(draft.signal(ir.Sampled(ir.Sampling.RATE, x)), 0.0)
    draft.above(draft.signal(ir.Sampled(ir.Sampling.PREVIOUS, x)), 0.0)
    gap = data.draw(durations)
    sending = replace(draft.channels[0], gaps_ns=(gap, 2 * gap))
    machine = replace(draft.machine(), channels=(sending, draft.channels[1]))
    inquiry = Inquiry(machine)
    never = [
        proposition
        for proposition in whole_propositions(machine)
        if never_at_rate(inquiry, proposition)
    ]
    assume(never)
    monitor = watching(machine)
    at_ns = 0
    for _ in range(16):
        monitor.update(at_ns, {0: ChannelValues({0: data.draw(numbers)}), 1: _HIGH})
        next_ns = at_ns + gap + data.draw(st.sampled_from((0, 0, 0, 1, TICK)))
        while at_ns < next_ns:
            values = values_of(machine, monitor)
            assert [
                proposition for proposition in never if values[proposition] is TruthValue.TRUE
            ] == []
            at_ns = min(at_ns + TICK, next_ns)
            if at_ns < next_ns:
                monitor.advance(at_ns)


_HIGH = ChannelValues({1: max(NUMBERS)})


@unhurried
@given(st.data())
def test_a_field_of_whole_numbers_may_hold_all_of_them(data: st.DataObject) -> None:
    limits = data.draw(st.sampled_from(((0.0, 255.0), (-128.0, 127.0), (0.0, 2.0**64))))
    scale, offset = data.draw(scales)
    draft = Draft()
    x = draft.signal(
        ir.Read(draft.slot(draft.input(draft.channel()), ir.FieldKind.REAL, scale, offset, limits))
    )
    raw = data.draw(st.one_of(st.sampled_from(limits), st.integers(*map(int, limits)).map(float)))
    equal = draft.proposition(
        ir.Compare(ir.Comparison.EQUAL, x, draft.constant(raw * scale + offset))
    )
    beyond = draft.above(x, limits[1] * scale + offset)
    inquiry = Inquiry(draft.machine())
    assert not inquiry.is_impossible(lambda state: state.proposition(equal).true)
    assert inquiry.is_impossible(lambda state: state.proposition(beyond).true)


def test_a_state_is_asked_of_one_machine_at_a_time() -> None:
    machine = ir.Machine("empty", (), (), (), (), (), (), (), ())
    assert ArbitraryState(Questioned(machine)).facts == []
