"""The executable semantics of a machine: the reference for every target.

The input is a machine that `ir.verify` has accepted. The code follows
`docs/explanation/semantics.md` rule by rule (S1, S2, ... in the comments) and prefers clarity to
speed: every node is evaluated every time.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rossmarie import ir
from rossmarie.interpreter.evaluate import Evaluator
from rossmarie.interpreter.inputs import InputUpdater
from rossmarie.interpreter.memory import fresh_memory
from rossmarie.interpreter.wake import next_wake
from rossmarie.ir import (
    Change,
    ChannelValues,
    Event,
    InputState,
    TimeJump,
    TruthValue,
    Verdict,
)


class Interpreter:
    """A monitor. Instants are nanoseconds on one clock, between `ir.EARLIEST_NS` and
    `ir.LATEST_NS`. Every method with an instant raises `ValueError` outside this range.
    """

    def __init__(self, machine: ir.Machine) -> None:
        self._machine = machine
        self._memory = fresh_memory(machine)
        self._inputs = InputUpdater(machine, self._memory)
        self._evaluator = Evaluator(machine, self._memory)
        self._active = [False] * len(machine.rules)

    @property
    def active(self) -> tuple[bool, ...]:
        """The rules that are active, by index."""
        return tuple(self._active)

    @property
    def signals(self) -> tuple[float, ...]:
        """The present value of each signal, by index; NaN is unknown."""
        return tuple(self._memory.signals)

    @property
    def arrays(self) -> tuple[Sequence[float], ...]:
        """The present elements of each array, by index; none before they arrive or after they
        expire.
        """
        return tuple(() if found is None else found for found in self._memory.arrays)

    def elements(self, signal: int) -> Sequence[float]:
        """The present value of an elementwise signal for each element."""
        return self._evaluator.elements.values(signal)

    @property
    def watches(self) -> tuple[TruthValue, ...]:
        """The values of the watched propositions, by index; unknown before the first event."""
        found = (self._memory.truth_values[proposition] for proposition in self._machine.watches)
        return tuple(TruthValue.UNKNOWN if value is None else value for value in found)

    @property
    def readings(self) -> tuple[float, ...]:
        """The values of the signals that memories of poses use, by index; NaN if unknown."""
        return tuple(self._memory.signals[signal] for signal in self._machine.readings)

    @property
    def input_states(self) -> tuple[InputState, ...]:
        """The states of the inputs, by index."""
        return tuple(present.state for present in self._memory.inputs)

    def age_ns(self, used: int) -> int | None:
        """The age in ns of the last message of an input; None before the first message."""
        present = self._memory.inputs[used]
        if present.state is InputState.NEVER or self._memory.now_ns is None:
            return None
        return self._memory.now_ns - present.stamp_ns

    def latch(self, rule: int) -> None:
        """Before the first event, make a latched rule active, as it was when its state was saved
        (S42). After the first event, and for other rules, this method has no effect.
        """
        if self._memory.now_ns is None and self._machine.rules[rule].release is None:
            self._active[rule] = True

    def next_wake(self) -> int | None:
        """The instant at which the caller has to call `advance` if no message comes before (S15);
        None if there is none.
        """
        return next_wake(self._machine, self._memory)

    def update(self, at_ns: int, messages: Mapping[int, ChannelValues]) -> list[Event]:
        """Process the messages that arrive at one instant, by channel index."""
        events = self._catch_up(at_ns)
        self._inputs.receive(at_ns, messages)
        return events + self._evaluate(at_ns, frozenset(messages))

    def advance(self, at_ns: int) -> list[Event]:
        """Let time pass without a message. Timers that are due exactly at this instant fire."""
        is_new = self._memory.now_ns is None or at_ns < self._memory.now_ns
        events = self._catch_up(at_ns)
        wake_ns = self.next_wake()
        if is_new or wake_ns == at_ns:
            events += self._evaluate(at_ns)
        self._memory.now_ns = at_ns
        return events

    def reset(self, at_ns: int, rule: int | None = None) -> list[Event]:
        """Reset one latched rule, or all latched rules if `rule` is None, for an operator. Latched
        rules with a false condition are cleared (S38).
        """
        events = self.advance(at_ns)
        resettable = range(len(self._machine.rules)) if rule is None else (rule,)
        for index in resettable:
            if self._machine.rules[index].release is None and self._is_over(index):
                events.append(self._change(index, Change.CLEARED, at_ns))
        return events

    # --- time --------------------------------------------------------------------------------

    def _catch_up(self, at_ns: int) -> list[Event]:
        """S13: fire the timers due before an instant. S17: handle an earlier instant as a jump."""
        if not ir.EARLIEST_NS < at_ns < ir.LATEST_NS:
            raise ValueError(f"an instant of {at_ns} ns is out of range")
        now_ns = self._memory.now_ns
        if now_ns is not None and at_ns < now_ns:
            self._inputs.restart(at_ns)
            self._memory.restart(at_ns)
            return [TimeJump(now_ns, at_ns)]
        events: list[Event] = []
        while (wake_ns := self.next_wake()) is not None and wake_ns < at_ns:
            events += self._evaluate(wake_ns)
        return events

    def _evaluate(self, at_ns: int, updated: frozenset[int] = frozenset()) -> list[Event]:
        """One evaluation: inputs expire, all signals and propositions are computed, rules change
        (S11).
        """
        expired = self._inputs.expire(at_ns)
        self._evaluator.evaluate(at_ns, updated, expired)
        self._memory.now_ns = at_ns
        return [
            self._change(index, change, at_ns)
            for index in range(len(self._machine.rules))
            if (change := self._due_change(index)) is not None
        ]

    # --- rules -------------------------------------------------------------------------------

    def _due_change(self, index: int) -> Change | None:
        """S35 to S37: the change of a rule in an evaluation; None if there is none."""
        rule = self._machine.rules[index]
        if not self._active[index]:
            return _ACTIVATIONS.get(self._proposition(rule.condition))
        if rule.release is None or not self._is_over(index):
            return None
        return Change.CLEARED if self._proposition(rule.release) is TruthValue.TRUE else None

    def _is_over(self, index: int) -> bool:
        """Say whether a rule is active and its condition is false."""
        condition = self._machine.rules[index].condition
        return self._active[index] and self._proposition(condition) is TruthValue.FALSE

    def _proposition(self, index: int) -> TruthValue:
        value = self._memory.truth_values[index]
        assert value is not None, "rules are read after an evaluation"
        return value

    def _change(self, index: int, change: Change, at_ns: int) -> Verdict:
        """Change a rule and return the verdict, with a snapshot of the values that it depends on
        (S41).
        """
        self._active[index] = change is not Change.CLEARED
        rule = self._machine.rules[index]
        return Verdict(
            rule=index,
            at_ns=at_ns,
            change=change,
            truth_values=tuple(self._proposition(term) for term in rule.terms),
            since_ns=tuple(self._memory.since_ns[term] for term in rule.terms),
            values=tuple(self._memory.signals[signal] for signal in rule.signals),
            inputs=tuple(self._memory.inputs[used].state for used in rule.inputs),
        )


_ACTIVATIONS: Mapping[TruthValue, Change] = {
    TruthValue.TRUE: Change.ACTIVATED,
    TruthValue.STALE: Change.ACTIVATED_STALE,
}
