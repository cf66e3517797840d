"""Durations that do not fit the message rates of a system model.

No other query relies on these rates, because a monitor also has to work if messages violate them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import z3

from dslkit.diagnostics import Remark
from rossmarie.analysis.activity import propositions_of
from rossmarie.analysis.finding import Finding, witness_note
from rossmarie.analysis.inquiry import AskedQuery, Inquiry
from rossmarie.analysis.rate_errors import (
    NeverAtRate,
    OneMessageEnough,
    StaleBetweenMessages,
    UnfitWindow,
)
from rossmarie.analysis.state import ArbitraryState
from rossmarie.analysis.trace import SymbolicTrace
from rossmarie.analysis.witness import Sending, View, Witness, views
from rossmarie.core import MOST_SAMPLES, SampleNumber, sampling_row
from rossmarie.ir import (
    AgeReaches,
    And,
    Between,
    Compare,
    Flag,
    Held,
    Input,
    Literal,
    Machine,
    Not,
    Or,
    Oscillates,
    Quantified,
    Recurs,
    Sampled,
    Since,
    TruthValue,
    compared_signals,
    reachable_propositions,
    reported_propositions,
    signal_operands,
)
from rossmarie.ir.duration_text import duration_text


def find_unfit_durations(inquiry: Inquiry) -> Iterator[Finding]:
    """A warning for each of three defects: an input is stale although its messages come at the
    declared rate; a part of a condition is therefore never true; a single message satisfies a
    `for`.
    """
    machine = inquiry.machine
    if all(channel.gaps_ns is None for channel in machine.channels):
        return
    roots = {
        root for rule in range(len(machine.rules)) for root in propositions_of(machine, (rule,))
    }
    used = sorted(
        {proposition for root in roots for proposition in reported_propositions(machine, root)}
    )
    rests_on = inquiry.asked.supports.propositions
    in_rules = {each for root in roots for each in rests_on[root].inputs}
    for index in sorted(in_rules):
        yield from _stale_between(inquiry, index)
    for signal in sorted({each for root in roots for each in rests_on[root].samples}):
        yield from _unfit_window(inquiry, signal)
    for proposition in used:
        yield from never_at_rate(inquiry, proposition) or _one_message(inquiry, proposition)


def _gaps(machine: Machine, channel: int) -> tuple[int, int]:
    """The least and the greatest time in ns between two messages. Without a declared rate, any time
    is possible.
    """
    return machine.channels[channel].gaps_ns or (0, 0)


def _apart(gaps: tuple[int, int]) -> str:
    least, greatest = map(duration_text, gaps)
    return f"{least} apart" if least == greatest else f"{least} to {greatest} apart"


# --- inputs that are stale between two messages -----------------------------------------------


def _stale_between(inquiry: Inquiry, index: int) -> Iterator[Finding]:
    machine = inquiry.machine
    declared = machine.inputs[index]
    gaps = _gaps(machine, declared.channel)
    if declared.timeout_ns is None or declared.timeout_ns >= gaps[1]:
        return
    finding = StaleBetweenMessages(
        input=declared.name,
        topic=machine.channels[declared.channel].topic,
        apart=_apart(gaps),
        timeout=duration_text(declared.timeout_ns),
        longest=duration_text(gaps[1]),
    )
    for rule, asked in enumerate(machine.rules):
        if index not in asked.inputs:
            continue
        witness = _loss(inquiry, declared, rule, gaps[1])
        if witness is not None:
            shown = witness_note(machine, witness, (asked.condition,))
            active = finding.BecomesActive(rule=asked.name, shown=shown)
            yield Finding(finding.at(declared.span, notes=(active,)), witness)
            return
    yield Finding(finding.at(declared.span))


def _loss(inquiry: Inquiry, declared: Input, rule: int, gap_ns: int) -> Witness | None:
    """A witness: a rule becomes active because an input is stale, and then the next message of the
    input comes.
    """
    condition = inquiry.machine.rules[rule].condition
    witness = inquiry.witness(
        AskedQuery(
            propositions_of(inquiry.machine, (rule,)),
            lambda state: state.proposition(condition).stale,
            partial(_comes_to_loss, declared=declared, rule=rule, gap_ns=gap_ns),
            partial(_is_seen_stale, rule=rule),
        )
    )
    if witness is None:
        return None
    sent = [event for event in witness.events if declared.channel in event.messages]
    if not sent or witness.end_ns - sent[-1].at_ns != declared.timeout_ns:
        return None
    next_ns = sent[-1].at_ns + gap_ns
    messages = {declared.channel: sent[-1].messages[declared.channel]}
    return Witness((*witness.events, Sending(next_ns, messages)), next_ns, is_calm=True)


def _comes_to_loss(trace: SymbolicTrace, declared: Input, rule: int, gap_ns: int) -> z3.BoolRef:
    found = []
    for number, moment in enumerate(trace.moments):
        age = moment.age(declared.channel)
        found.append(
            z3.And(
                trace.is_active(rule, number),
                z3.Not(trace.is_active(rule, number - 1)),
                moment.proposition(trace.asked.machine.rules[rule].condition).stale,
                moment.has_arrived(declared.channel),
                age >= (declared.timeout_ns or 0),
                age < gap_ns,
            )
        )
    return z3.Or(found)


def _is_seen_stale(seen: Sequence[View], rule: int) -> bool:
    was_active = len(seen) < 2 or seen[-2].active[rule]
    condition = seen[-1].truth_values.values()
    return seen[-1].active[rule] and not was_active and TruthValue.STALE in condition


# --- windows of samples ----------------------------------------------------------------------


def _unfit_window(inquiry: Inquiry, index: int) -> Iterator[Finding]:
    """A warning for a window that contains only one sample, or fewer samples than arrive in it."""
    machine, signal = inquiry.machine, inquiry.machine.signals[index]
    channels = inquiry.asked.supports.signals[index].channels
    window_ns = inquiry.asked.window_of(index)
    has_window = isinstance(signal.node, Sampled) and sampling_row(signal.node.function).has_window
    if not has_window or len(channels) != 1:
        return
    (channel,) = channels
    least_ns, _ = gaps = _gaps(machine, channel)
    if least_ns == 0:
        return
    topic, window = machine.channels[channel].topic, duration_text(window_ns)
    finding = UnfitWindow(text=signal.text, topic=topic, apart=_apart(gaps))
    count = -(-window_ns // least_ns)
    if count > MOST_SAMPLES:
        many = finding.TooMany(count=count, window=window, most=MOST_SAMPLES)
        shorter = finding.Shorter(longest=duration_text(MOST_SAMPLES * least_ns))
        yield Finding(finding.at(signal.span, notes=(many,), help=shorter))
    elif count == 1:
        longer = finding.Longer(least=duration_text(least_ns))
        yield Finding(finding.at(signal.span, notes=(finding.Single(window=window),), help=longer))


# --- parts that are never true ---------------------------------------------------------------


def never_at_rate(inquiry: Inquiry, proposition: int) -> list[Finding]:
    """A finding if a part cannot be true while messages come at the declared rate."""
    machine = inquiry.machine
    for channel in sorted(inquiry.asked.supports.propositions[proposition].channels):
        gaps = _gaps(machine, channel)
        reason = _reason(inquiry, proposition, channel, gaps[0])
        if reason is not None:
            part = machine.propositions[proposition]
            topic = machine.channels[channel].topic
            held = [rule.name for rule in machine.rules if rule.release == proposition]
            finding = NeverAtRate(condition=part.text, topic=topic)
            notes = (
                finding.Rate(topic=topic, apart=_apart(gaps), reason=reason),
                *(finding.NeverCleared(rule=rule) for rule in held),
            )
            return [Finding(finding.at(part.span, notes=notes))]
    return []


def _reason(inquiry: Inquiry, proposition: int, channel: int, gap_ns: int) -> Remark | None:
    """The reason why a part is never true if messages on a channel are `gap_ns` apart; None if the
    part can be true.
    """
    machine = inquiry.machine
    match machine.propositions[proposition].node:
        case Held(operand=operand, duration_ns=duration_ns):
            over_ns = _over_after(inquiry, operand, channel, min(gap_ns, duration_ns + 1))
            if over_ns is not None:
                text, over = machine.propositions[operand].text, duration_text(over_ns)
                return NeverAtRate.Over(age=over, condition=text)
        case Oscillates(count=count, window_ns=window_ns) as node:
            if inquiry.asked.supports.signals[node.signal].channels != {channel}:
                return None
            if (count - 1) * gap_ns >= window_ns:
                time = duration_text((count - 1) * gap_ns)
                return NeverAtRate.TurningPoints(count=count, time=time)
            return _forgotten(inquiry, node.signal, channel, gap_ns)
        case (
            Literal() | Compare() | Between() | Flag() | AgeReaches() | Quantified() | Not()
            | And() | Or() | Since() | Recurs()
        ) as node:  # fmt: skip
            for signal in _remembering(machine, compared_signals(node)):
                reason = _forgotten(inquiry, signal, channel, gap_ns)
                if reason is not None:
                    return reason
    return None


def _over_after(inquiry: Inquiry, operand: int, channel: int, below_ns: int) -> int | None:
    """An age of the last message, below a limit, at which a condition is proved to be false or
    unknown; None if there is none. Only timeouts and ages in the rules can cause this.
    """
    machine = inquiry.machine
    support = inquiry.asked.supports.propositions[operand]
    inputs = {used for used in support.inputs if machine.inputs[used].channel == channel}
    ages = {machine.inputs[used].timeout_ns for used in inputs} - {None}
    for below in reachable_propositions(machine, operand):
        node = machine.propositions[below].node
        if isinstance(node, AgeReaches) and node.input in inputs:
            ages.add(node.age_ns)
    for age_ns in sorted(age for age in ages if age is not None):
        if age_ns < below_ns and inquiry.is_impossible(
            partial(_is_true_at_age, proposition=operand, channel=channel, age_ns=age_ns)
        ):
            return age_ns
    return None


def _is_true_at_age(
    state: ArbitraryState, proposition: int, channel: int, age_ns: int
) -> z3.BoolRef:
    is_old = z3.Or(z3.Not(state.has_arrived(channel)), state.age(channel) >= age_ns)
    return z3.And(state.proposition(proposition).true, is_old)


def _remembering(machine: Machine, signals: Sequence[int]) -> Iterator[int]:
    """The signals for which other signals need two samples."""
    waiting = list(signals)
    while waiting:
        node = machine.signals[waiting.pop()].node
        if isinstance(node, Sampled):
            declared = sampling_row(node.function)
            if SampleNumber.BEFORE in declared.views and not declared.feeds_back:
                yield node.signal
        waiting += signal_operands(node)


def _forgotten(inquiry: Inquiry, signal: int, channel: int, gap_ns: int) -> Remark | None:
    """The reason why a signal never has two samples (S21); None if it can have two samples."""
    machine = inquiry.machine
    support = inquiry.asked.supports.signals[signal]
    if support.channels != {channel}:
        return None
    inputs = {used for used in support.inputs if machine.inputs[used].channel == channel}
    for used in sorted(inputs):
        timeout_ns = machine.inputs[used].timeout_ns
        if timeout_ns is not None and timeout_ns < gap_ns:
            name, timeout = machine.inputs[used].name, duration_text(timeout_ns)
            return NeverAtRate.Forgotten(input=name, timeout=timeout)
    return None


# --- durations that one message fulfils -------------------------------------------------------


def _one_message(inquiry: Inquiry, proposition: int) -> Iterator[Finding]:
    """A finding if a witness shows that a `for` becomes true after a single message of each
    topic.
    """
    machine = inquiry.machine
    part = machine.propositions[proposition]
    channels = sorted(inquiry.asked.supports.propositions[proposition].channels)
    if not isinstance(part.node, Held) or not channels:
        return
    least_ns = min(_gaps(machine, channel)[0] for channel in channels)
    if part.node.duration_ns >= least_ns:
        return
    witness = inquiry.witness(
        AskedQuery(
            (proposition,),
            lambda state: state.proposition(proposition).true,
            lambda trace: z3.Or([moment.proposition(proposition).true for moment in trace.moments]),
            lambda seen: seen[-1].truth_values[proposition] is TruthValue.TRUE,
        )
    )
    alone = (
        None if witness is None else _alone(machine, witness, proposition, part.node.duration_ns)
    )
    if alone is not None:
        finding = OneMessageEnough(
            condition=part.text,
            topics=" and ".join(machine.channels[channel].topic for channel in channels),
            least=duration_text(least_ns),
        )
        note = witness_note(machine, alone, (proposition,))
        yield Finding(finding.at(part.span, notes=(note,)), alone)


def _alone(
    machine: Machine, witness: Witness, proposition: int, duration_ns: int
) -> Witness | None:
    """The one event of a witness that alone makes a `for` true; None if there is none."""
    for event in witness.events:
        alone = Witness((Sending(0, event.messages),), duration_ns, witness.is_calm)
        *_, last = views(machine, alone, (proposition,))
        if last.truth_values[proposition] is TruthValue.TRUE:
            return alone
    return None
