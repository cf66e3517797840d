"""No call takes more evaluations than the structure of its machine allows; some take as many."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from support.depth import examples
from support.drafts import SECOND, Draft
from support.machines import Advance, Case, cases, take, traces

TICK = SECOND // 10
SILENCE_NS = 1000 * SECOND


class Counting(Interpreter):
    """Counts evaluations, and how often each `for` falls due."""

    def __init__(self, machine: ir.Machine) -> None:
        super().__init__(machine)
        self.forget()

    def forget(self) -> None:
        self.evaluations = 0
        self.matured = [0] * len(self._machine.propositions)

    def _evaluate(self, at_ns: int, updated: frozenset[int] = frozenset()) -> list[ir.Event]:
        before = [value is ir.TruthValue.TRUE for value in self._memory.truth_values]
        events = super()._evaluate(at_ns, updated)
        self.evaluations += 1
        for index, proposition in enumerate(self._machine.propositions):
            is_true = self._memory.truth_values[index] is ir.TruthValue.TRUE
            if isinstance(proposition.node, ir.Held) and is_true and not before[index]:
                self.matured[index] += 1
        return events


@st.composite
def timer_cases(draw: st.DrawFn) -> Case:
    """Many `for` over each other and over the other timers, which change without messages."""
    draft = Draft()
    guarded, number = draft.read(8 * TICK), draft.read()
    ticks = st.integers(1, 12).map(lambda count: count * TICK)
    propositions = [draft.above(guarded, 0.0), draft.above(number, 0.0)]
    propositions += [
        draft.proposition(ir.Oscillates(x, 1, draw(ticks), 0.0)) for x in (guarded, number)
    ]
    for age_ns in draw(st.lists(ticks, min_size=1, max_size=6)):
        propositions.append(draft.proposition(ir.AgeReaches(0, age_ns)))
    for _ in range(draw(st.integers(3, 20))):
        some = st.one_of(st.sampled_from(propositions), st.sampled_from(propositions[-3:]))
        nodes = st.one_of(
            st.builds(ir.Not, some),
            st.builds(ir.And, st.tuples(some, some)),
            st.builds(ir.Or, st.tuples(some, some)),
            st.builds(ir.Held, some, st.integers(1, 3 * TICK), st.booleans()),
            st.builds(ir.Since, some, some),
            st.builds(ir.Recurs, some, st.integers(1, 3), st.integers(1, 3 * TICK)),
        )
        propositions.append(draft.proposition(draw(nodes)))
    draft.rule(propositions[-1])
    machine = draft.machine()
    return machine, draw(traces(machine, max_steps=6))


@settings(max_examples=examples(4))
@given(st.one_of(cases(), timer_cases()))
def test_nothing_falls_due_more_often_than_the_bound_says(case: Case) -> None:
    machine, trace = case
    most = ir.most_evaluations(machine)
    of_propositions = [count for _, count in ir.wakes(machine)][len(machine.inputs) :]
    interpreter = Counting(machine)
    silence = Advance(max(step.at_ns for step in trace) + SILENCE_NS)
    for step in (*trace, silence):
        interpreter.forget()
        take(interpreter, step)
        assert interpreter.evaluations <= most
        pairs = zip(interpreter.matured, of_propositions, strict=True)
        assert all(matured <= count for matured, count in pairs)


def chain(levels: int) -> ir.Machine:
    """Pulses over pulses: each condition is true for a while after each change of the one before
    it, and that while is half as long.
    """
    draft = Draft()
    while_ns = SECOND
    condition = draft.proposition(ir.AgeReaches(draft.input(draft.channel()), 2 * SECOND))
    for _ in range(levels):
        while_ns //= 2
        opposite = draft.proposition(ir.Not(condition))
        risen, fallen = (
            draft.proposition(
                ir.And((now, draft.proposition(ir.Not(draft.proposition(ir.Held(now, while_ns))))))
            )
            for now in (condition, opposite)
        )
        condition = draft.proposition(ir.Or((risen, fallen)))
    draft.rule(condition)
    return draft.machine()


@pytest.mark.parametrize("levels", [0, 1, 2, 9])
def test_a_chain_reaches_the_bound(levels: int) -> None:
    machine = chain(levels)
    interpreter = Counting(machine)
    message = {0: ir.ChannelValues({}, {})}
    interpreter.update(0, message)
    interpreter.forget()
    interpreter.update(SILENCE_NS, message)
    assert interpreter.evaluations == ir.most_evaluations(machine) == 2 ** (levels + 1)
