"""Rules that activate each other, or themselves, by the messages that they publish."""

from __future__ import annotations

import enum
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import z3

from rossmarie import ir
from rossmarie.analysis.activity import becomes_active, is_cleared, propositions_of
from rossmarie.analysis.closed_loop import Loop, Outside
from rossmarie.analysis.closed_state import Carried, ClosedState, Ends, Published
from rossmarie.analysis.draft import Draft, drafted, witness_of
from rossmarie.analysis.errors import RulesAlternate, Undecided
from rossmarie.analysis.finding import Finding, witness_note
from rossmarie.analysis.hints import hints
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.published import Publisher, publications, values_of
from rossmarie.analysis.shrink import Replays, shortened
from rossmarie.analysis.solver import Satisfiability, ask
from rossmarie.analysis.terms import constant
from rossmarie.analysis.trace import Leg, SymbolicTrace
from rossmarie.analysis.witness import Witness
from rossmarie.ir import ChannelValues, Machine
from rossmarie.ir.duration_text import duration_text
from rossmarie.ir.reactions import Publish, timeout_ns

SECOND = 1_000_000_000
_MOST_RULES = 3
"""The most rules in one circle."""

_TIMES = 2
"""The number of times that each rule of a circle has to become active."""


_MOST_TRIES = 40


def find_alternating(inquiry: Inquiry) -> Iterator[Finding]:
    """A warning for each group of rules that activate each other repeatedly by the messages that
    they publish.
    """
    published = list(publications(inquiry.machine))
    circles = [Circle(inquiry, each, published) for each in _circles(inquiry, published)]
    waiting = [each for each in circles if not each.is_impossible()]
    shown: list[frozenset[int]] = []
    for world in _World:
        found = frozenset[int]().union(*shown)
        for circle in waiting:
            if circle.group <= found or any(each <= circle.group for each in shown):
                continue
            finding = circle.alternating(world)
            if finding is not None:
                shown.append(circle.group)
                yield finding
    opened = {each.group: each for each in reversed(waiting)}
    reported = frozenset[int]().union(*shown)
    for group, circle in opened.items():
        if not (group <= reported or any(each <= group for each in shown)):
            yield circle.open()


def _circles(inquiry: Inquiry, published: Sequence[Publisher]) -> Iterator[tuple[Publisher, ...]]:
    """Circles of rules, the shortest first: each rule publishes a message that the next rule reads.
    Latched rules are left out, because they are not cleared.
    """
    machine = inquiry.machine
    free = [each for each in published if machine.rules[each.rule].release is not None]
    reads = {each.rule: _read(inquiry, each.rule) for each in free}
    for length in range(1, _MOST_RULES + 1):
        for first in free:
            yield from _longer((first,), length, free, reads)


def _longer(
    path: tuple[Publisher, ...],
    length: int,
    free: Sequence[Publisher],
    reads: Mapping[int, frozenset[int]],
) -> Iterator[tuple[Publisher, ...]]:
    """The circles of a given length that begin with a path. The first rule of the path has the
    lowest number in the circle.
    """
    if len(path) == length:
        if path[-1].channel in reads[path[0].rule]:
            yield path
        return
    for each in free:
        is_new = each.rule > path[0].rule and all(each.rule != other.rule for other in path)
        if is_new and path[-1].channel in reads[each.rule]:
            yield from _longer((*path, each), length, free, reads)


def _read(inquiry: Inquiry, rule: int) -> frozenset[int]:
    """The channels that a rule depends on."""
    propositions = propositions_of(inquiry.machine, (rule,))
    found = (inquiry.asked.supports.propositions[each] for each in propositions)
    return frozenset().union(*(ir.all_channels(inquiry.machine, support) for support in found))


# --- one circle ------------------------------------------------------------------------------


class Circle:
    """A circle of rules, and the part of the machine that the rules depend on. Each rule publishes
    a message that the next rule reads.
    """

    def __init__(
        self, inquiry: Inquiry, circle: Sequence[Publisher], published: Sequence[Publisher]
    ) -> None:
        self._machine = inquiry.machine
        self._circle = circle
        self._rules = [each.rule for each in circle]
        self._published = [each for each in published if each.rule in self._rules]
        self._part = inquiry.about(*self._rules)
        self._propositions = propositions_of(self._part.machine, tuple(range(len(circle))))

    @property
    def group(self) -> frozenset[int]:
        """The rules."""
        return frozenset(self._rules)

    def alternating(self, world: _World) -> Finding | None:
        """A warning with a witness in this world, or None."""
        for beginning in _Beginning:
            for start in range(len(self._circle)):
                witness = self._witness(start, beginning, world)
                if witness is not None:
                    return _alternating(self._machine, self._circle, witness)
        return None

    def open(self) -> Finding:
        """The finding that the query about this circle is undecided."""
        return _open(self._machine, self._circle)

    # --- the proof ---------------------------------------------------------------------------

    def is_impossible(self) -> bool:
        """Say whether it is proved, for any constant messages from outside, that at least one of
        the rules cannot become active and be cleared.
        """
        self._part.check_time()
        predicates = []
        for place in range(len(self._rules)):
            for moment, predicate in enumerate((becomes_active, is_cleared)):
                state = ClosedState(self._part.asked, self._carried())
                predicates.append(state.at(2 * place + moment, predicate(state, place)))
        return ask([], z3.And(predicates)).outcome is Satisfiability.IMPOSSIBLE

    def _carried(self) -> Published:
        found: dict[int, Carried] = {}
        for each in self._published:
            effect = self._machine.reactions.tasks[each.task].effect
            assert isinstance(effect, Publish)
            is_bounded = effect.command is not None
            slots = values_of(self._machine, each.task, each.channel).slots
            ends = {index: _ends(raw, is_bounded) for index, raw in slots.items()}
            before = found.get(each.channel, Carried((), is_open=False))
            is_open = before.is_open or is_bounded or not each.is_sure
            found[each.channel] = Carried((*before.messages, ends), is_open)
        return found

    # --- the witness -------------------------------------------------------------------------

    def _witness(self, start: int, beginning: _Beginning, world: _World) -> Witness | None:
        """A trace that begins with one of the rules, or None. The interpreter confirms it."""
        order = [*range(start, len(self._rules)), *range(start)]
        self._part.check_time()
        is_whole = beginning in (_Beginning.TURNS, _Beginning.CIRCLE)
        trace = SymbolicTrace(
            self._part.asked, self._propositions, len(order) + 1 if is_whole else 1
        )
        predicate = self._follows(trace, order)
        if beginning is not _Beginning.ANY:
            predicate = z3.And(predicate, trace.is_active(start, 1))
        if beginning is _Beginning.TURNS:
            predicate = z3.And(predicate, _is_each_alone(trace, order))
        is_calm = world is not _World.SILENT
        wishes = trace.calm if is_calm else ()
        for preferred in hints(trace):
            answer = ask(trace.facts, predicate, *wishes, *preferred)
            if answer.model is None:
                continue
            whole = drafted(trace, answer.model, is_calm=is_calm)
            first = replace(whole.legs[0], length_ns=0, shakes={})
            played = _Played(self._machine, self._part.machine, self._rules, world)
            draft = replace(whole, legs=(first,))
            witness = shortened(self._part.machine, draft, played)
            if witness is not None:
                return witness
        return None

    def _follows(self, trace: SymbolicTrace, order: Sequence[int]) -> z3.BoolRef:
        """The facts that each rule becomes active by the message of the rule before it, and that
        the first rule is inactive before its next turn.
        """
        found = [z3.BoolVal(True)]
        for number in range(1, len(trace.legs)):
            message = self._circle[order[number - 1]]
            found.append(self._brings(trace.legs[number - 1], trace.legs[number], message))
            turn = order[number % len(order)]
            found.append(trace.is_active(turn, 2 * number + 1))
        if len(trace.legs) > 1:
            later = range(2, len(trace.moments))
            found.append(z3.Or([z3.Not(trace.is_active(order[0], each)) for each in later]))
        return z3.And(found)

    def _brings(self, before: Leg, leg: Leg, message: Publisher) -> z3.BoolRef:
        """The fact that a leg sends a message of a rule, besides the messages of the leg before."""
        machine = self._machine
        values = values_of(machine, message.task, message.channel)
        found = []
        for channel, sends in leg.sends.items():
            is_published = channel == message.channel
            found.append(sends if is_published else sends == before.sends[channel])
        for index, number in leg.slots.items():
            slot, was = machine.slots[index], before.slots[index]
            if machine.inputs[slot.input].channel != message.channel:
                found += [number.known == was.known, number.value == was.value]
            elif math.isnan(values.slots[index]):
                found.append(z3.Not(number.known))
            else:
                value = constant(values.slots[index] * slot.scale + slot.offset)
                found += [number.known, number.value == value]
        for index, cells in leg.cells.items():
            if machine.inputs[machine.arrays[index].input].channel != message.channel:
                for cell, earlier in zip(cells, before.cells[index], strict=True):
                    found.append(cell.is_there == earlier.is_there)
                    found.append(cell.number.value == earlier.number.value)
        return z3.And(found)


def _is_each_alone(trace: SymbolicTrace, order: Sequence[int]) -> z3.BoolRef:
    """The fact that at the end of each leg only the rule whose turn it is can be active."""
    ends = range(1, len(trace.moments), 2)
    turns = [order[number % len(order)] for number in range(len(trace.legs))]
    return z3.And(
        [
            z3.Not(trace.is_active(other, end))
            for turn, end in zip(turns, ends, strict=True)
            for other in order
            if other != turn
        ]
    )


def _ends(raw: float, is_bounded: bool) -> Ends:
    return (min(0.0, raw), max(0.0, raw)) if is_bounded else (raw, raw)


class _World(enum.Enum):
    """The environment of the rules. Commands that rules replace return as soon as no rule commands.
    A command with no required period is sent once.
    """

    OWN = "all sensors work, and no other node publishes while the rules publish"
    SHARED = "all sensors work, and other nodes continue to publish if a timeout needs messages"
    SILENT = "a sensor is missing, or falls silent"


class _Beginning(enum.Enum):
    """The outside messages at the beginning of a trace."""

    TURNS = "with the following messages of the rules, exactly one rule is active at a time"
    CIRCLE = "with the following messages of the rules, each rule makes the next rule active"
    ACTIVE = "they make the first rule active"
    ANY = "nothing"


class _Played(Replays):
    """A closed-loop test of a draft: whether the rules alternate after its messages."""

    def __init__(
        self, machine: Machine, part: Machine, rules: Sequence[int], world: _World
    ) -> None:
        super().__init__(part, lambda _: False, ())
        self._whole = machine
        self._world = world
        self._rules = rules
        self._tries = _MOST_TRIES
        self._until_ns = _long_enough(machine, part, rules)

    def show(self, draft: Draft) -> Witness | None:
        """Run the messages from outside and the messages of the rules until each rule has become
        active again. Returns None if that does not happen, or if it also happens without the
        messages of the rules.
        """
        events = witness_of(self._machine, draft).events
        if self._tries <= 0 or not events:
            return None
        self._tries -= 1
        ends = (True, False) if _awaits(self._whole, self._rules) else (True,)
        for outside in self._outsides(events[0].messages, draft.period_ns):
            for ends_well in ends:
                loop = self._loop(outside, True, ends_well)
                end_ns = loop.run(self._until_ns, _TIMES)
                if end_ns is None or (draft.is_calm and loop.has_gap):
                    continue
                alone = self._loop(outside, False, ends_well)
                alone.run(end_ns, _TIMES)
                if all(len(starts) < _TIMES for starts in alone.starts.values()):
                    return Witness(tuple(loop.sent), end_ns, draft.is_calm)
        return None

    def _outsides(self, messages: Mapping[int, ChannelValues], period_ns: int) -> Iterator[Outside]:
        """The possible messages from outside on the topics of the rules."""
        commanded = {each.topic for each in self._whole.reactions.commands}
        own = frozenset(
            each.channel
            for each in publications(self._whole)
            if each.rule in self._rules
            and self._whole.channels[each.channel].topic not in commanded
        )
        timed = own & {used.channel for used in self._whole.inputs if used.timeout_ns is not None}
        nothing = frozenset[int]()
        if self._world is _World.SHARED:
            yield Outside(messages, period_ns, own - timed, nothing)
            return
        yield Outside(messages, period_ns, own, nothing)
        if timed:
            yield Outside(messages, period_ns, own - timed, timed)

    def _loop(self, outside: Outside, is_closed: bool, ends_well: bool) -> Loop:
        return Loop(self._whole, self._machine, self._rules, outside, is_closed, ends_well)


def _awaits(machine: Machine, rules: Sequence[int]) -> bool:
    tasks = [task for rule in rules for task in machine.reactions.plans[rule].tasks]
    return any(timeout_ns(machine.reactions.tasks[task].effect) is not None for task in tasks)


def _long_enough(machine: Machine, part: Machine, rules: Sequence[int]) -> int:
    """A time in ns in which each timer of some rules and their inputs expires often enough."""
    found = [used.timeout_ns or 0 for used in part.inputs]
    for proposition in part.propositions:
        match proposition.node:
            case ir.Held(duration_ns=time_ns) | ir.AgeReaches(age_ns=time_ns):
                found.append(time_ns)
            case ir.Oscillates(window_ns=time_ns) | ir.Recurs(window_ns=time_ns):
                found.append(time_ns)
            case (
                ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.Quantified()
                | ir.Not() | ir.And() | ir.Or() | ir.Since()
            ):  # fmt: skip
                pass
    for rule in rules:
        for task in machine.reactions.plans[rule].tasks:
            effect = machine.reactions.tasks[task].effect
            if isinstance(effect, Publish) and effect.period_ns is not None:
                found.append(effect.period_ns)
    return SECOND + 2 * _TIMES * sum(found)


# --- words -----------------------------------------------------------------------------------


def _alternating(machine: Machine, circle: Sequence[Publisher], witness: Witness) -> Finding:
    finding = RulesAlternate(
        rules=_named(machine, circle),
        whom="set each other" if circle[1:] else "sets itself",
        topic=machine.channels[circle[0].channel].topic,
        reader=_reader(machine, circle, 0),
    )
    places = [
        finding.Other(
            topic=machine.channels[each.channel].topic, reader=_reader(machine, circle, place)
        ).at(machine.rules[each.rule].head)
        for place, each in enumerate(circle)
        if place > 0
    ]
    propositions = propositions_of(machine, tuple(each.rule for each in circle))
    note = witness_note(machine, witness, propositions)
    who = "each of them" if circle[1:] else "it"
    often = finding.Often(who=who, within=duration_text(witness.end_ns))
    head = machine.rules[circle[0].rule].head
    return Finding(finding.at(head, *places, notes=(note, often)), witness)


def _named(machine: Machine, circle: Sequence[Publisher]) -> str:
    names = [f"`{machine.rules[each.rule].name}`" for each in circle]
    return f"rules {', '.join(names[:-1])} and {names[-1]}" if names[1:] else f"rule {names[0]}"


def _reader(machine: Machine, circle: Sequence[Publisher], place: int) -> str:
    following = circle[(place + 1) % len(circle)]
    return "it" if len(circle) == 1 else f"`{machine.rules[following.rule].name}`"


def _open(machine: Machine, circle: Sequence[Publisher]) -> Finding:
    whom = "each other" if circle[1:] else "itself"
    query = f"can {_named(machine, circle)} set {whom} off by publishing?"
    reason = "no short trace shows it, and no proof excludes it"
    finding = Undecided(query=query, reason=reason)
    return Finding(finding.at(machine.rules[circle[0].rule].head))
