"""Whatever random machines do on random traces, the analysis holds for possible; what it proves
impossible never happens.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import z3
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.analysis.activity import together
from rossmarie.analysis.encoding import Questioned
from rossmarie.analysis.implied import needs
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.solver import Outcome, ask
from rossmarie.analysis.state import ArbitraryState
from rossmarie.interpreter import Interpreter
from rossmarie.ir import TruthValue
from support.machines import Case, cases, machines, take, traces

unhurried = settings(
    deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much]
)


def whole_truths(machine: ir.Machine) -> tuple[int, ...]:
    arrays = ir.element_arrays(machine).truths
    return tuple(index for index, array in enumerate(arrays) if array is None)


def evaluations(case: Case) -> list[tuple[TruthValue, ...]]:
    """The values of all truths right after each event, each combination once."""
    machine, trace = case
    watching = replace(machine, watches=whole_truths(machine))
    monitor = Interpreter(watching)
    seen = []
    for step in trace:
        take(monitor, step)
        seen.append(monitor.watches)
    return list(dict.fromkeys(seen))


@unhurried
@given(cases())
def test_every_evaluation_is_a_state(case: Case) -> None:
    machine, _ = case
    for values in evaluations(case)[:6]:
        inquiry = Inquiry(machine)
        state = ArbitraryState(inquiry.asked)
        claim = z3.And(
            [
                state.truth(truth).is_value(value)
                for truth, value in zip(whole_truths(machine), values, strict=True)
            ]
        )
        orders = list(inquiry.orders(state))
        answer = ask([*state.facts, *orders], claim)
        assert answer.outcome is not Outcome.IMPOSSIBLE, (values, state.facts)


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


def test_a_state_is_asked_of_one_machine_at_a_time() -> None:
    machine = ir.Machine("empty", (), (), (), (), (), (), (), ())
    assert ArbitraryState(Questioned(machine)).facts == []
