"""Rules: rules S35 to S41 of docs/explanation/semantics.md."""

import math

from hypothesis import given, settings

from rossmarie.interpreter import Interpreter
from rossmarie.ir import Change, Held, InputState, Literal, Not, Or, TruthValue, Verdict
from support.bench import Bench, reported
from support.depth import examples
from support.drafts import SECOND, Draft
from support.machines import NAN, Case, Update, cases, take

F, T, U, L = TruthValue


def test_s35_true_activates() -> None:
    draft = Draft()
    draft.rule(draft.above(draft.read(), 0.0))
    bench = Bench(draft)
    assert reported(bench.send(0, c0=-1.0)) == []
    assert reported(bench.send(1, c0=1.0)) == [(0, 1.0, Change.ACTIVATED)]
    assert reported(bench.send(2, c0=2.0)) == []
    assert bench.monitor.active == (True,)


def test_s35_stale_activates() -> None:
    draft = Draft()
    draft.rule(draft.above(draft.read(timeout_ns=SECOND), 0.0))
    bench = Bench(draft)
    assert reported(bench.send(0, c0=-1.0)) == []
    assert reported(bench.advance(2)) == [(0, 1.0, Change.ACTIVATED_STALE)]
    assert reported(bench.send(3, c0=1.0)) == []


def test_s36_without_a_contract_false_clears() -> None:
    draft = Draft()
    draft.rule(draft.above(draft.read(), 0.0))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    assert reported(bench.send(1, c0=-1.0)) == [(0, 1.0, Change.CLEARED)]
    assert bench.monitor.active == (False,)


def test_s36_clear_when() -> None:
    draft = Draft()
    x, y = draft.read(), draft.read()
    draft.rule(draft.above(x, 0.0), draft.above(y, 0.0))
    bench = Bench(draft)
    bench.send(0, c0=1.0, c1=1.0)  # a true release alone does not clear
    assert bench.monitor.active == (True,)
    assert reported(bench.send(1, c0=-1.0, c1=-1.0)) == []
    assert reported(bench.send(2, c1=1.0)) == [(0, 2.0, Change.CLEARED)]


def test_s36_clear_for() -> None:
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    draft.rule(positive, draft.proposition(Held(draft.proposition(Not(positive)), 2 * SECOND)))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.send(1, c0=-1.0)
    bench.send(2, c0=1.0)
    bench.send(3, c0=-1.0)
    assert reported(bench.advance(9)) == [(0, 5.0, Change.CLEARED)]


def test_s37_unknown_neither_activates_nor_clears() -> None:
    draft = Draft()
    draft.rule(draft.above(draft.read(), 0.0))
    bench = Bench(draft)
    assert bench.send(0, c0=NAN) == []
    bench.send(1, c0=1.0)
    assert bench.send(2, c0=NAN) == []
    assert bench.monitor.active == (True,)


def test_s38_a_reset_clears_while_the_condition_is_false() -> None:
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    draft.rule(positive, latched=True)
    draft.rule(positive, draft.proposition(Literal(False)))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    assert bench.send(1, c0=-1.0) == []
    assert reported(bench.reset(2)) == [(0, 2.0, Change.CLEARED)]
    assert bench.monitor.active == (False, True)


def test_s38_a_reset_has_no_later_effect() -> None:
    draft = Draft()
    draft.rule(draft.above(draft.read(), 0.0), latched=True)
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    assert bench.reset(1) == []
    assert bench.send(2, c0=-1.0) == []
    assert bench.monitor.active == (True,)
    bench.send(3, c0=NAN)
    assert bench.reset(3) == []


def test_s38_a_reset_of_one_rule() -> None:
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    for _ in range(2):
        draft.rule(positive, latched=True)
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.send(1, c0=-1.0)
    assert reported(bench.reset(2, rule=1)) == [(1, 2.0, Change.CLEARED)]
    assert reported(bench.reset(2, rule=1)) == []


@settings(max_examples=examples(2))
@given(cases())
def test_s39_a_rule_changes_once_in_an_evaluation(case: Case) -> None:
    machine, trace = case
    monitor = Interpreter(machine)
    for step in trace:
        if isinstance(step, Update):
            monitor.advance(step.at_ns)
        changes = [event.rule for event in take(monitor, step) if isinstance(event, Verdict)]
        if isinstance(step, Update):
            assert len(changes) == len(set(changes))


def test_s40_verdicts_come_in_the_order_of_the_rules() -> None:
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    draft.rule(draft.proposition(Not(positive)))
    draft.rule(positive)
    draft.rule(positive)
    bench = Bench(draft)
    bench.send(0, c0=-1.0)
    assert reported(bench.send(1, c0=1.0)) == [
        (0, 1.0, Change.CLEARED),
        (1, 1.0, Change.ACTIVATED),
        (2, 1.0, Change.ACTIVATED),
    ]


def test_s41_a_verdict_carries_a_snapshot() -> None:
    draft = Draft()
    x = draft.read(timeout_ns=9 * SECOND)
    y = draft.read()
    positive, large = draft.above(x, 0.0), draft.above(y, 5.0)
    draft.rule(draft.proposition(Held(draft.proposition(Or((positive, large))), 2 * SECOND)))
    bench = Bench(draft)
    bench.send(0, c0=-1.0)
    bench.send(1, c0=1.5)
    (verdict,) = bench.advance(5)
    assert isinstance(verdict, Verdict)
    assert verdict == Verdict(
        rule=0,
        at_ns=3 * SECOND,
        change=Change.ACTIVATED,
        truth_values=(T, U, T),
        since_ns=(SECOND, 0, 3 * SECOND),
        values=(1.5, verdict.values[1]),
        inputs=(InputState.FRESH, InputState.NEVER),
    )
    assert math.isnan(verdict.values[1])


def latching() -> Bench:
    """A latched rule and one that is not, over one number."""
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    draft.rule(positive, latched=True)
    draft.rule(positive)
    return Bench(draft)


def test_s42_a_latched_rule_is_restored() -> None:
    bench = latching()
    bench.monitor.latch(0)
    bench.monitor.latch(1)
    assert bench.monitor.active == (True, False)
    assert reported(bench.send(0, c0=1.0)) == [(1, 0.0, Change.ACTIVATED)]
    assert reported(bench.reset(1)) == []  # its condition is true
    assert reported(bench.send(2, c0=-1.0)) == [(1, 2.0, Change.CLEARED)]
    assert reported(bench.reset(3)) == [(0, 3.0, Change.CLEARED)]


def test_s42_after_the_first_event_nothing_is_restored() -> None:
    bench = latching()
    bench.advance(0)
    bench.monitor.latch(0)
    assert bench.monitor.active == (False, False)
