"""Explanations of verdicts: from the snapshot in a verdict to the user's own words.

The input is a verified machine and a verdict of it. The causes are the parts of the rule's
condition that alone decide its value:

- all operands of a true `and`, and the true operands of a true `or`;
- all operands of a false `or`, and the false operands of a false `and`;
- the unknown operands of an unknown `and` or `or`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from dslkit.source import Span
from rossmarie.ir import kleene
from rossmarie.ir import model as ir
from rossmarie.ir.defined import defined
from rossmarie.ir.support import compared_signals, is_leaf, kind_of, leaf_propositions, supports
from rossmarie.ir.verdict import Change, Event, InputState, TruthValue, Verdict


@dataclass(frozen=True)
class Reading:
    """The value of a signal, in the unit that the user sees. `shown` is the value with its unit."""

    signal: int
    text: str
    value: float
    unit: str
    shown: str


@dataclass(frozen=True)
class Cause:
    """A deciding condition, with the values that it compares.

    `name` is the user's name of the condition, or of the nearest condition around it. `since_ns` is
    the instant since which it has had its value; for a true `C for d`, the instant since which C
    has been true. `limits` are the values of the named constants that the condition compares with.
    """

    proposition: int
    name: str | None
    text: str
    value: TruthValue
    since_ns: int
    readings: tuple[Reading, ...]
    limits: tuple[str, ...]
    span: Span

    def line(self, origin_ns: int = 0) -> str:
        """One line; instants are shown in seconds after `origin_ns`."""
        word = _WORDS[self.value]
        # "x = 3 m, not in [1, 2] m" reads better than "x = 3 m, x not in [1, 2] m".
        lone = f"{self.readings[0].text} " if len(self.readings) == 1 else ""
        shown = [f"{reading.text} = {reading.shown}" for reading in self.readings]
        shown.append(self.text.removeprefix(lone))
        flag = self.text.removeprefix("not ")
        if [reading.text for reading in self.readings] == [flag]:
            # "on, false" reads better than "on = false, not on, true".
            word = word if flag == self.text else _WORDS[kleene.negation(self.value)]
            shown = [flag]
        shown += self.limits
        since = f"{word} since {(self.since_ns - origin_ns) / 1e9:.3f} s"
        prefix = f"{self.name}: " if self.name else ""
        return prefix + ", ".join((*shown, since))


@dataclass(frozen=True)
class StaleInput:
    """An input that is to blame for an unknown condition. FRESH means that messages come without a
    usable value, or that the input `was_stale` earlier, within the time that the condition looks
    back.
    """

    input: int
    name: str
    topic: str
    state: InputState
    was_stale: bool = False

    def line(self) -> str:
        """One line."""
        state = "was stale earlier" if self.was_stale else _STATES[self.state]
        return f"input {self.name} ({self.topic}) {state}"


@dataclass(frozen=True)
class Explanation:
    """The explanation of an activation or a clearing. `contract` is the condition for clearing. If
    the rule stands for an exemption, `exempted` is the rule that is not applied.
    """

    rule: str
    at_ns: int
    change: Change
    causes: tuple[Cause, ...]
    stale_inputs: tuple[StaleInput, ...]
    contract: str
    exempted: str | None = None

    def lines(self, origin_ns: int = 0) -> tuple[str, ...]:
        """A line for each stale input; if no input is to blame, a line for each cause. The first
        line names the rule that is not applied, if there is one.
        """
        first = () if self.exempted is None else (self.exempted,)
        if self.stale_inputs:
            return (*first, *(stale.line() for stale in self.stale_inputs))
        return (*first, *(cause.line(origin_ns) for cause in self.causes))

    def line(self, origin_ns: int = 0) -> str:
        """The whole explanation on one line."""
        return "; ".join(self.lines(origin_ns))


_WORDS = {
    TruthValue.FALSE: "false",
    TruthValue.TRUE: "true",
    TruthValue.UNKNOWN: "unknown",
    TruthValue.STALE: "unknown",
}

_STATES = {
    InputState.NEVER: "has never been received",
    InputState.EXPIRED: "is older than its timeout",
    InputState.FRESH: "has no usable value",
}


def event_line(machine: ir.Machine, event: Event) -> str:
    """An event in words: the rule, the change, and its causes."""
    if not isinstance(event, Verdict):
        return f"time went back from {event.from_ns} ns to {event.to_ns} ns"
    change = event.change.name.partition("_")[0].lower()
    return f"{machine.rules[event.rule].name} {change}: {explain(machine, event).line()}"


def explain(machine: ir.Machine, verdict: Verdict) -> Explanation:
    """The causes of a verdict, in the order in which the rule's condition names them."""
    rule = machine.rules[verdict.rule]
    snapshot = _Snapshot(machine, verdict)
    causes: dict[int, Cause] = {}
    for cause in snapshot.causes(rule.condition):
        causes.setdefault(cause.proposition, cause)
    return Explanation(
        rule=rule.name,
        at_ns=verdict.at_ns,
        change=verdict.change,
        causes=tuple(causes.values()),
        stale_inputs=snapshot.stale_inputs(tuple(causes.values())),
        contract=rule.contract,
        exempted=exemption_words(rule) if snapshot.is_exemption_used() else None,
    )


def exemption_words(rule: ir.Rule) -> str | None:
    """The words for the exemption that a rule stands for: the rule that is not applied, the running
    skill, and its permissions. None if the rule stands for no exemption.
    """
    exempts = rule.exempts
    if exempts is None:
        return None
    permits = f", which permits {' and '.join(exempts.permits)}" if exempts.permits else ""
    return f"{exempts.rule} is not applied: {exempts.doing}{permits}"


class _Snapshot:
    """The content of a verdict, by the indexes of the machine."""

    def __init__(self, machine: ir.Machine, verdict: Verdict) -> None:
        rule = machine.rules[verdict.rule]
        self._machine, self._verdict, self._rule = machine, verdict, rule
        self._propositions = dict(zip(rule.terms, verdict.truth_values, strict=True))
        self._since_ns = dict(zip(rule.terms, verdict.since_ns, strict=True))
        self._values = dict(zip(rule.signals, verdict.values, strict=True))
        self._inputs = dict(zip(rule.inputs, verdict.inputs, strict=True))

    def is_exemption_used(self) -> bool:
        """Say whether the rule stands for an exemption whose skill is known to run. If the rule is
        active because of a stale input, the context may be missing as well.
        """
        is_active = self._verdict.change is not Change.CLEARED
        exempts = self._rule.exempts
        return (
            is_active
            and exempts is not None
            and any(
                value is TruthValue.TRUE
                and self._machine.propositions[proposition].text == exempts.doing
                for proposition, value in self._propositions.items()
            )
        )

    def causes(self, condition: int) -> Iterator[Cause]:
        """The causes that decided a condition, from left to right."""
        waiting: list[tuple[int, str | None]] = [(condition, None)]
        while waiting:
            proposition, around = waiting.pop()
            name = self._machine.propositions[proposition].name or around
            if self._is_unit(proposition):
                yield self._cause(proposition, around)
            else:
                waiting += [(operand, name) for operand in reversed(self._deciding(proposition))]

    def stale_inputs(self, causes: tuple[Cause, ...]) -> tuple[StaleInput, ...]:
        """The inputs to blame, if causes are unknown because an input is missing."""
        unknown = [each.proposition for each in causes if each.value is TruthValue.STALE]
        leaves = [
            leaf
            for proposition in unknown
            for leaf in leaf_propositions(self._machine, proposition)
        ]
        stale = [leaf for leaf in leaves if self._propositions[leaf] is TruthValue.STALE]
        rests_on = supports(self._machine).propositions if leaves else ()
        blamed = {used for leaf in stale or leaves for used in self._blamed(rests_on[leaf].inputs)}
        return tuple(self._stale(index, was_stale=not stale) for index in sorted(blamed))

    def _blamed(self, inputs: frozenset[int]) -> set[int]:
        guarded = {i for i in inputs if self._machine.inputs[i].timeout_ns is not None}
        silent = {index for index in guarded if self._inputs[index] is not InputState.FRESH}
        return silent or guarded

    def _stale(self, index: int, *, was_stale: bool) -> StaleInput:
        declared = self._machine.inputs[index]
        topic = self._machine.channels[declared.channel].topic
        state = self._inputs[index]
        return StaleInput(
            index, declared.name, topic, state, was_stale and state is InputState.FRESH
        )

    # --- causes ------------------------------------------------------------------------------

    def _deciding(self, proposition: int) -> tuple[int, ...]:
        """The operands that alone decide a proposition: operands of equal value, or the negated
        operand. For an operator that looks back in time, the operands that it names.
        """
        whole = defined(self._machine, proposition)
        if whole is not None:
            return whole.operands
        match self._machine.propositions[proposition].node:
            case ir.And(operands=operands) | ir.Or(operands=operands):
                value = self._value(proposition)
                return tuple(operand for operand in operands if self._value(operand) is value)
            case ir.Not(operand=operand) | ir.Held(operand=operand):
                return (operand,)
            case ir.Since(held=held, begun=begun):
                return (held, begun)
            case (
                ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches()
                | ir.Oscillates() | ir.Quantified() | ir.Recurs()
            ):  # fmt: skip
                return ()

    def _is_unit(self, proposition: int) -> bool:
        """Say whether a proposition is reported as a whole: a leaf, a duration, a count of edges,
        or a negation of one of these.
        """
        node = self._machine.propositions[proposition].node
        while isinstance(node, ir.Not):
            node = self._machine.propositions[node.operand].node
        return is_leaf(node) or isinstance(node, ir.Held | ir.Since | ir.Recurs)

    def _cause(self, proposition: int, around: str | None) -> Cause:
        chain = tuple(self._chain(proposition))
        names = (self._machine.propositions[index].name for index in chain)
        return Cause(
            proposition=proposition,
            name=next(filter(None, names), around),
            text=self._machine.propositions[proposition].text,
            value=self._value(proposition),
            since_ns=self._since(proposition),
            readings=tuple(map(self._reading, self._compared(proposition, constant=False))),
            limits=tuple(self._limits(proposition)),
            span=self._machine.propositions[proposition].span,
        )

    def _chain(self, proposition: int) -> Iterator[int]:
        """The proposition, and the operands that it negates or prolongs, from the outside to the
        inside.
        """
        yield proposition
        node = self._machine.propositions[proposition].node
        while isinstance(node, ir.Not | ir.Held):
            yield node.operand
            node = self._machine.propositions[node.operand].node

    def _since(self, proposition: int) -> int:
        node = self._machine.propositions[proposition].node
        is_true = isinstance(node, ir.Held) and self._value(proposition) is TruthValue.TRUE
        if isinstance(node, ir.Held) and is_true and not node.initially:
            return self._since_ns[proposition] - node.duration_ns
        # A negation changes together with its operand.
        return next(self._since_ns[i] for i in self._chain(proposition) if i in self._since_ns)

    def _compared(self, proposition: int, *, constant: bool) -> Iterator[int]:
        """The signals that the deciding leaves compare, each once."""
        signals: dict[int, None] = {}
        waiting = [proposition]
        while waiting:
            index = waiting.pop()
            waiting += reversed(self._deciding(index))
            for signal in compared_signals(self._machine.propositions[index].node):
                is_constant = isinstance(self._machine.signals[signal].node, ir.Constant)
                if is_constant if constant else signal in self._values:
                    signals.setdefault(signal)
        return iter(signals)

    def _limits(self, proposition: int) -> Iterator[str]:
        """Named constants with their values. Both ends of an interval have its name."""
        ends: dict[str, list[float]] = {}
        units: dict[str, str] = {}
        for index in self._compared(proposition, constant=True):
            signal = self._machine.signals[index]
            if signal.text.isidentifier() and isinstance(signal.node, ir.Constant):
                ends.setdefault(signal.text, []).append(
                    signal.node.value * signal.scale + signal.offset
                )
                units[signal.text] = signal.unit
        for name, values in ends.items():
            shown = ", ".join(f"{value:.6g}" for value in values)
            shown = f"[{shown}]" if len(values) > 1 else shown
            yield f"{name} = {shown} {units[name]}".rstrip()

    def _reading(self, index: int) -> Reading:
        signal = self._machine.signals[index]
        value = self._values[index]
        shown = value * signal.scale + signal.offset
        return Reading(index, signal.text, shown, signal.unit, self._shown(index, shown))

    def _shown(self, index: int, value: float) -> str:
        if value != value:
            return "unknown"
        match kind_of(self._machine, index):
            case ir.FieldKind.FLAG:
                return str(value != 0.0).lower()
            case ir.FieldKind.TEXT:
                texts = self._machine.texts
                return f'"{texts[int(value)]}"' if value >= 0.0 else "another string"
            case ir.FieldKind.REAL:
                return f"{value:.6g} {self._machine.signals[index].unit}".rstrip()

    def _value(self, proposition: int) -> TruthValue:
        """The value of any proposition below the rule's condition, from the snapshot or computed
        from it.
        """
        if proposition in self._propositions:
            return self._propositions[proposition]
        match self._machine.propositions[proposition].node:
            case ir.Literal(value=value):
                return kleene.proposition_of(value)
            case ir.Not(operand=operand):
                return kleene.negation(self._value(operand))
            case ir.And(operands=operands):
                return kleene.conjunction(self._value(operand) for operand in operands)
            case ir.Or(operands=operands):
                return kleene.disjunction(self._value(operand) for operand in operands)
            case (
                ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches() | ir.Oscillates()
                | ir.Quantified() | ir.Held() | ir.Since() | ir.Recurs()
            ) as node:  # fmt: skip
                raise AssertionError(f"{type(node).__name__} is among the terms of its rule")
