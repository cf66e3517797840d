"""Invariants of the memory of a monitor between its functions, as C.

The input is a layout and its definitions; the result is predicates. Three moments matter. A monitor
is *at rest* between two calls. It has *caught up* with an instant if no timer is due before the
instant. It has *looked* at its numbers and timers at an instant if every wrong proposition is
marked. Each predicate is a list of sentences, so that a proof can name the failing sentence.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rossmarie.ir import model as ir
from rossmarie.verification.definitions import Definitions
from rossmarie.verification.layout import KeptNumber, ProofLayout
from rossmarie.verification.places import WatchedGuard
from rossmarie.verification.recent import enough, first_recent, recent, window_end
from rossmarie.verification.supports import propositions_of

_OLDEST = "(-LATEST)"


@dataclass(frozen=True)
class Sentence:
    """A true statement, as C over `m` and `t_ns`. `about` describes it to readers."""

    about: str
    holds: str


def users_of(layout: ProofLayout, proposition: int) -> list[int]:
    """The nodes that have a proposition as an operand: propositions, then rules."""
    machine = layout.machine
    found = [
        layout.node_of_proposition[index]
        for index in layout.derived
        if proposition in propositions_of(machine.propositions[index].node)
    ]
    for number, rule in enumerate(machine.rules):
        if proposition in (rule.condition, rule.release):
            found.append(layout.proposition_count + number)
    return found


def remark_of(value: KeptNumber) -> str:
    """The description of a value, without the remark about its place."""
    return value.remark.split("  ", 1)[-1]


def oscillation(layout: ProofLayout, k: int) -> ir.Oscillates:
    """The k-th of the oscillations that a monitor follows."""
    node = layout.machine.propositions[layout.oscillations[k]].node
    assert isinstance(node, ir.Oscillates), "the layout lists oscillations"
    return node


def _is_true_initially(machine: ir.Machine, proposition: int) -> bool:
    node = machine.propositions[proposition].node
    return isinstance(node, ir.Held) and node.initially


class Invariants:
    """Writes the predicates of one machine."""

    def __init__(self, layout: ProofLayout, definitions: Definitions) -> None:
        self._layout = layout
        self._machine = layout.machine
        self._definitions = definitions

    def _text(self, proposition: int) -> str:
        return self._machine.propositions[proposition].text

    # --- marks -------------------------------------------------------------------------------

    def marked(self, node: int) -> str:
        """State that a proposition or rule is to be evaluated."""
        if self._layout.is_small:
            return f"((m->dirty >> {node} & 1) != 0)"
        return f"((m->dirty[{node // 64}] >> {node % 64} & 1) != 0)"

    def nothing_marked(self) -> str:
        """State that no proposition and no rule is to be evaluated."""
        if self._layout.is_small:
            return "m->dirty == 0"
        words = (self._layout.proposition_count + len(self._machine.rules) + 63) // 64
        return " && ".join([*(f"m->dirty[{word}] == 0" for word in range(words)), "!m->pending"])

    def marks_are_in_range(self) -> str:
        """State that only rules, and propositions that are evaluated when marked, are marked."""
        first = self._layout.leaf_count
        last = self._layout.proposition_count + len(self._machine.rules)
        if self._layout.is_small:
            mask = (1 << last) - (1 << first)
            return f"(m->dirty & ~UINT64_C({mask:#x})) == 0"
        parts = []
        for word in range((last + 63) // 64):
            bits = sum(1 << (n - 64 * word) for n in range(first, last) if n // 64 == word)
            parts.append(f"(m->dirty[{word}] & ~UINT64_C({bits:#x})) == 0")
        somewhere = " || ".join(f"m->dirty[{word}] != 0" for word in range((last + 63) // 64))
        return " && ".join([*parts, f"(m->pending || !({somewhere}))"])

    # --- sentences ---------------------------------------------------------------------------

    def clock(self) -> Iterator[Sentence]:
        """Instants lie in a range in which differences fit into 64 bits."""
        yield Sentence("the monitor has started", "m->started")
        yield Sentence("the clock is in range", "m->now_ns > EARLIEST && m->now_ns < LATEST")
        yield Sentence(
            "the clock is not ahead of the instant", "m->now_ns <= t_ns && t_ns < LATEST"
        )
        for used in range(len(self._machine.inputs)):
            stamp = f"m->stamp_ns[{used}]"
            held = f"{stamp} >= {_OLDEST} && {stamp} <= t_ns"
            yield Sentence(f"the stamp of {self._machine.inputs[used].name} is in the past", held)
        for proposition, node in self._layout.node_of_proposition.items():
            since = f"m->since_ns[{node}]"
            held = f"m->truth_value[{node}] == UNSET || ({since} >= {_OLDEST} && {since} <= t_ns)"
            yield Sentence(f"`{self._text(proposition)}` changed in the past", held)
        for k in range(len(self._layout.sampled)):
            for name in ("latest_ns", "before_ns"):
                held = f"m->{name}[{k}] >= {_OLDEST} && m->{name}[{k}] < LATEST"
                yield Sentence("instants of samples are in range", held)

    def inputs(self, slack: str) -> Iterator[Sentence]:
        """S9 and S10. `slack` is `<` if an input at its timeout has expired, else `<=`."""
        for index, used in enumerate(self._machine.inputs):
            state, about = f"m->state[{index}]", f"the state of {used.name} fits its timeout"
            in_time = f"t_ns - m->stamp_ns[{index}] {slack} INT64_C({used.timeout_ns})"
            fresh = f"({state} != FRESH || {in_time})"
            timed = f"{state} != EXPIRED" if used.timeout_ns is None else fresh
            yield Sentence(about, f"{state} <= EXPIRED && {timed}")
            held = f"!m->quiet[{used.channel}] || {state} == FRESH"
            yield Sentence(f"{used.name} is fresh while its channel is quiet", held)
        for slot, declared in enumerate(self._machine.slots):
            value = f"m->value[{self._layout.places.value_of_slot[slot]}]"
            path = ".".join(map(str, declared.path))
            held = f"!isinf({value}) && (m->state[{declared.input}] == FRESH || isnan({value}))"
            yield Sentence(f"`{path}` is finite or unknown, and unknown without its input", held)
        yield from self._computed()

    def _computed(self) -> Iterator[Sentence]:
        """S9: a computed number is unknown if an input that it needs is not fresh. A result over
        elements may be known although a number beside the elements is unknown: the result over no
        elements is (S74).
        """
        for index, value in enumerate(self._layout.values):
            used = sorted(value.support.needed)
            if value.slot is None and used:
                fresh = " && ".join(f"m->state[{each}] == FRESH" for each in used)
                about = f"`{remark_of(value)}` is unknown if an input that it needs is not fresh"
                yield Sentence(about, f"isnan(m->value[{index}]) || ({fresh})")

    def quiet(self) -> Iterator[Sentence]:
        """A message on a quiet channel changes no age that a proposition uses."""
        for proposition in self._layout.ages:
            node = self._machine.propositions[proposition].node
            assert isinstance(node, ir.AgeReaches), "the layout lists ages"
            channel = self._machine.inputs[node.input].channel
            held = f"!m->quiet[{channel}] || {self._definitions.proposition(proposition)} == FALSE"
            text = self._text(proposition)
            yield Sentence(f"on a quiet channel `{text}` is false", held)

    def literals(self) -> Iterator[Sentence]:
        """Propositions that never change have their values."""
        for proposition in self._layout.literals:
            yield self._is_right(proposition)

    def guard(self, number: int, guard: WatchedGuard) -> Iterator[Sentence]:
        """A guard encloses its number, and its propositions have the values for this number."""
        for proposition in guard.leaves:
            yield self._is_right(proposition)
        yield from self.tests(guard)
        x, low, high = f"m->value[{guard.value}]", f"m->low[{number}]", f"m->high[{number}]"
        place = f"m->place[{number}]"
        first, last = self.places(number)
        node = self._layout.node_of_proposition[guard.leaves[0]]
        unknown = (
            f"({place} == -(int)m->truth_value[{node}] && {low} == INFINITY && {high} == -INFINITY)"
        )
        above, below = f"{x} > {low}", f"{x} <= {high}"
        signal = self._layout.values[guard.value].signal
        if signal is not None and self._definitions.can_be_infinite(signal):
            above = f"({above} || ({x} == -INFINITY && {place} == {first}))"
            below = f"({below} || ({x} == INFINITY && {place} == {last}))"
        around = (
            f"({place} >= {first} && {place} <= {last} && {low} == limits[{place}].at && "
            f"{high} == limits[{place} + 1].at && {above} && {below})"
        )
        about = remark_of(self._layout.values[guard.value])
        yield Sentence(
            f"the guard of `{about}` encloses its number", f"isnan({x}) ? {unknown} : {around}"
        )

    def tests(self, guard: WatchedGuard) -> Iterator[Sentence]:
        """A guarded value may be a flag or a comparison, kept as a number: 0, 1 or unknown."""
        x = f"m->value[{guard.value}]"
        for proposition in guard.leaves:
            if not self.is_test(proposition):
                continue
            holds = f"isnan({x}) || {x} == 0.0 || {x} == 1.0"
            if not isinstance(
                self._machine.propositions[proposition].node, ir.Quantified | ir.Flag
            ):
                meant = f"spec_proposition_{proposition}(m, t_ns)"
                known = f"{x} == ({meant} == TRUE ? 1.0 : 0.0)"
                holds = f"{meant} >= UNKNOWN ? isnan({x}) : {known}"
            yield Sentence(f"`{self._text(proposition)}` is kept as 0, 1 or unknown", holds)

    def is_test(self, proposition: int) -> bool:
        """Say whether the number behind a proposition can only be 0, 1 or unknown."""
        is_flag = isinstance(self._machine.propositions[proposition].node, ir.Flag)
        return is_flag or proposition in self._layout.places.value_of_test

    def places(self, number: int) -> tuple[int, int]:
        """The first and the last place that a guard can have."""
        first = sum(other.limit_count + 2 for other in self._layout.guards[:number])
        return first, first + self._layout.guards[number].limit_count

    def _is_right(self, proposition: int) -> Sentence:
        text = self._text(proposition)
        value = self._definitions.proposition(proposition)
        is_right = f"{value} == spec_proposition_{proposition}(m, t_ns)"
        return Sentence(f"`{text}` has its defined value", is_right)

    def ages(self) -> Iterator[Sentence]:
        """S31: propositions about ages have their values."""
        for proposition in self._layout.ages:
            yield self._is_right(proposition)

    def derived(self) -> Iterator[Sentence]:
        """Compound propositions have the values that follow from their operands, unless they are
        marked.
        """
        for proposition in self._layout.derived:
            node = self._layout.node_of_proposition[proposition]
            sentence = self._is_right(proposition)
            holds = [sentence.holds, *self._timer(proposition)]
            held = f"{self.marked(node)} || ({' && '.join(holds)})"
            yield Sentence(sentence.about, held)
        for proposition in self._layout.held:
            before = f"m->held_before[{self._layout.held.index(proposition)}]"
            text = self._text(proposition)
            held = f"{before} == FALSE || {before} == UNKNOWN || {before} == STALE"
            if _is_true_initially(self._machine, proposition):
                held = f"{before} <= STALE"
            yield Sentence(f"the value of `{text}` before it began is possible", held)
        for k, proposition in enumerate(self._layout.sinces):
            before, text = f"m->since_before[{k}]", self._text(proposition)
            marked = self.marked(self._layout.node_of_proposition[proposition])
            reported = f"{before} == {self._definitions.proposition(proposition)}"
            yield Sentence(f"`{text}` keeps a truth value", f"{before} <= STALE")
            yield Sentence(f"`{text}` keeps its value (S44)", f"{marked} || {reported}")

    def _timer(self, proposition: int) -> Iterator[str]:
        """S33: the due instant of a duration is its end, or NEVER if the duration has not begun.
        S48: the remembered value of a condition with counted edges is its present value.
        """
        node = self._machine.propositions[proposition].node
        if isinstance(node, ir.Held):
            due = f"m->held_due_ns[{self._layout.held.index(proposition)}]"
            operand = self._definitions.proposition(node.operand)
            start = self._definitions.since(node.operand)
            yield f"{due} == ({operand} == TRUE ? {start} + INT64_C({node.duration_ns}) : NEVER)"
        elif isinstance(node, ir.Recurs):
            k, operand = (
                self._layout.recent.index(proposition),
                self._definitions.proposition(node.operand),
            )
            gap, end = f"m->gap[{k}]", f"m->gap_end_ns[{k}]"
            yield f"m->edge_before[{self._layout.recurring.index(proposition)}] == {operand}"
            yield f"({operand} < UNKNOWN ? {end} != NEVER : {end} == NEVER && {gap} == {operand})"

    def rules(self) -> Iterator[Sentence]:
        """S35 to S38: the facts about a rule that hold whatever its state was before."""
        for index, rule in enumerate(self._machine.rules):
            condition = self._definitions.proposition(rule.condition)
            active = f"(m->active[{index // 8}] >> {index % 8} & 1) != 0"
            holds = f"({condition} != TRUE && {condition} != STALE || {active})"
            if rule.release is not None:
                release = self._definitions.proposition(rule.release)
                cleared = f"({condition} != FALSE || {release} != TRUE || !({active}))"
                holds = f"({holds} && {cleared})"
            unless = self.marked(self._layout.proposition_count + index)
            yield Sentence(
                f"rule {rule.name} is active according to S35 to S38", f"{unless} || {holds}"
            )

    def timers(self, least: str) -> Iterator[Sentence]:
        """No timer lies before an instant (S15)."""
        for index, used in enumerate(self._machine.inputs):
            if used.timeout_ns is not None:
                due = f"m->stamp_ns[{index}] + INT64_C({used.timeout_ns})"
                held = f"m->state[{index}] != FRESH || {due} >= {least}"
                yield Sentence(f"the timeout of {used.name} lies ahead", held)
        for proposition in self._layout.ages:
            node = self._machine.propositions[proposition].node
            assert isinstance(node, ir.AgeReaches), "the layout lists ages"
            due = f"m->stamp_ns[{node.input}] + INT64_C({node.age_ns})"
            held = f"{self._definitions.proposition(proposition)} != FALSE || {due} >= {least}"
            yield Sentence(f"`{self._text(proposition)}` becomes true later", held)
        for k, proposition in enumerate(self._layout.held):
            ended = f"{self._definitions.proposition(proposition)} == TRUE"
            marked = self.marked(self._layout.node_of_proposition[proposition])
            held = f"{marked} || {ended} || m->held_due_ns[{k}] >= {least}"
            yield Sentence(f"the end of `{self._text(proposition)}` lies ahead", held)
        yield from self._recent_timers(least)

    # --- turning points and edges ------------------------------------------------------------

    def recent(self) -> Iterator[Sentence]:
        """S32, S48: the stored turning points and edges are consistent."""
        for k, proposition in enumerate(self._layout.recent):
            count, first = recent(self._layout, k).count, first_recent(self._layout, k)
            about = f"the instants kept for `{self._text(proposition)}` fit"
            sane = f"m->recent_count[{k}] <= {count} && m->recent_next[{k}] < {count}"
            yield Sentence(about, sane)
            for place in range(first, first + count):
                instant = f"m->recent_ns[{place}]"
                yield Sentence(about, f"{instant} >= {_OLDEST} && {instant} < LATEST")
            gap, end = f"m->gap[{k}]", f"m->gap_end_ns[{k}]"
            yield Sentence(about, f"{gap} == FALSE || {gap} == UNKNOWN || {gap} == STALE")
            yield Sentence(about, f"{end} == NEVER || ({end} >= EARLIEST && {end} <= t_ns)")
        for k in range(len(self._layout.oscillations)):
            heading = f"m->heading[{k}] >= -1 && m->heading[{k}] <= 1"
            yield Sentence("the direction of a number is up, down or unknown", heading)

    def swinging(self) -> Iterator[Sentence]:
        """The seen state of each oscillation is up to date. Its proposition agrees, or it is
        marked.
        """
        for k, proposition in enumerate(self._layout.oscillations):
            text = self._text(proposition)
            seen = f"m->swinging[{k}] == {self.seen(k)}"
            yield Sentence(f"the seen value of `{text}` is up to date", seen)
            waited = f"m->swinging[{k}] != TRUE || {window_end(self._layout, k)} >= m->wake_ns"
            yield Sentence(f"the monitor wakes before the window of `{text}` ends", waited)
            marked = self.marked(self._layout.node_of_proposition[proposition])
            yield Sentence(f"`{text}` has its defined value", f"{marked} || {self.reported(k)}")

    def seen(self, k: int) -> str:
        """The value for the present window: whether enough turning points lie in it."""
        proposition = self._layout.oscillations[k]
        x = self._definitions.number(oscillation(self._layout, k).signal)
        is_enough = enough(self._layout, k)
        return f"(!isfinite({x}) ? spec_unknown_{proposition}(m) : {is_enough} ? TRUE : FALSE)"

    def reported(self, k: int) -> str:
        """State that the monitor reports the seen value. After a gap it reports the seen value once
        the gap is older than the window.
        """
        proposition, node = self._layout.oscillations[k], oscillation(self._layout, k)
        value, seen = self._definitions.proposition(proposition), f"m->swinging[{k}]"
        gap, end = f"m->gap[{k}]", f"m->gap_end_ns[{k}]"
        over = f"({seen} == TRUE || t_ns - {end} >= INT64_C({node.window_ns}))"
        stale = f"{value} == {seen} && {gap} == {seen} && {end} == NEVER"
        known = f"{end} != NEVER && {value} == ({over} ? {seen} : {gap})"
        return f"({seen} >= UNKNOWN ? ({stale}) : ({known}))"

    def _recent_timers(self, least: str) -> Iterator[Sentence]:
        for k, proposition in enumerate(self._layout.recent):
            window_ns = recent(self._layout, k).window_ns
            value, end = self._definitions.proposition(proposition), f"m->gap_end_ns[{k}]"
            marked = self.marked(self._layout.node_of_proposition[proposition])
            true = f"({value} != TRUE || {window_end(self._layout, k)} >= {least})"
            after = f"{end} + INT64_C({window_ns})"
            gap = f"({value} < UNKNOWN || {end} == NEVER || {after} >= {least})"
            about = f"the window of `{self._text(proposition)}` ends later"
            yield Sentence(about, f"{marked} || ({true} && {gap})")

    def guards(self) -> dict[str, WatchedGuard]:
        """The guards, by the names of their predicates."""
        return {f"guard_{number}": guard for number, guard in enumerate(self._layout.guards)}

    # --- moments -----------------------------------------------------------------------------

    def groups(self) -> dict[str, list[Sentence]]:
        """All sentences, grouped by the name of their predicate."""
        return {
            "clock": list(self.clock()),
            "marks": [Sentence("each marked node can be evaluated", self.marks_are_in_range())],
            "unmarked": [Sentence("no node is marked", self.nothing_marked())],
            "in_time": list(self.inputs("<")),
            "just_in_time": list(self.inputs("<=")),
            "quiet": list(self.quiet()),
            **{name: list(self.guard(n, g)) for n, (name, g) in enumerate(self.guards().items())},
            "literals": list(self.literals()),
            "ages": list(self.ages()),
            "recent": list(self.recent()),
            "swinging": list(self.swinging()),
            "derived": list(self.derived()),
            "rules": list(self.rules()),
            "ahead": list(self.timers("t_ns")),
            "woken": [
                Sentence("the next wake lies in range", "m->wake_ns <= LATEST"),
                *self.timers("m->wake_ns"),
            ],
        }
