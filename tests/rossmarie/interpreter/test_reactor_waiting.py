"""Waiting too long: rule R15 of docs/explanation/reactions.md."""

from rossmarie.interpreter import TaskState
from rossmarie.ir import TruthValue, reactions
from support.drafts import SECOND
from support.plans import (
    Plans,
    ReactorBench,
    cancel,
    log,
    publish,
    send,
    set_parameter,
    switch,
)

HALF = SECOND // 2


def rivals(one: reactions.Effect, other: reactions.Effect, watches: int = 0) -> ReactorBench:
    """Two rules, each with one of these effects and a line of the log behind its `else`: tasks 1
    and 0 of the first rule, 3 and 2 of the second.
    """
    plans = Plans()
    for effect in (one, other):
        plans.rule([plans.task(effect, otherwise=[plans.task(log())])])
    return ReactorBench(plans, watches=watches)


def overruled_cancel(confirmation: int | None = None) -> ReactorBench:
    """Task 3 wants to cancel, while task 1 sends a goal for ten seconds."""
    return rivals(send(timeout_ns=10 * SECOND), cancel(confirmation, HALF), watches=1)


def test_r15_what_waits_in_vain_fails_when_its_time_is_over() -> None:
    bench = overruled_cancel()
    assert bench.react(0, 0, 1) == ["start 1", "overruled 3 by 0"]
    assert bench.react(0.4, 0, 1) == []
    assert bench.react(0.5, 0, 1) == ["failed 3", "start 2"]
    assert bench.state(3) is TaskState.OVERDUE
    assert bench.react(9, 0, 1) == []


def test_r15_of_what_ran_the_time_goes_on() -> None:
    bench = overruled_cancel()
    bench.react(0, 1)
    assert bench.react(0.25, 0, 1) == ["overruled 3 by 0", "start 1"]
    assert bench.react(0.5, 0, 1) == ["failed 3", "start 2"]


def test_r15_of_what_held_the_time_begins() -> None:
    bench = overruled_cancel()
    bench.react(0, 1)
    bench.succeed(0.25, 3)
    bench.react(1, 0, 1)
    assert bench.react(1.4, 0, 1) == []
    assert bench.react(1.5, 0, 1) == ["failed 3", "start 2"]


def test_r15_what_was_overruled_when_its_time_is_over_fails_at_that_look() -> None:
    bench = overruled_cancel()
    bench.react(0, 1)
    assert bench.react(0.5, 0, 1) == ["overruled 3 by 0", "start 1", "failed 3", "start 2"]


def test_r15_a_confirmation_answers_for_a_cancel_while_it_is_true() -> None:
    bench = overruled_cancel(confirmation=0)
    bench.watches = [TruthValue.TRUE]
    bench.react(0, 0, 1)
    assert bench.react(5, 0, 1) == []
    assert bench.state(3) is TaskState.WAITING
    bench.watches = [TruthValue.UNKNOWN]
    assert bench.react(6, 0, 1) == ["failed 3", "start 2"]


def test_r15_a_cancel_with_a_confirmation_does_not_take_the_word_of_another() -> None:
    bench = rivals(cancel(None, HALF), cancel(0, HALF), watches=1)
    bench.react(0, 0, 1)
    bench.succeed(0.25, 1)
    assert bench.react(0.5, 0, 1) == ["failed 3", "start 2"]


def test_r15_another_rule_that_does_the_same_answers_while_it_holds() -> None:
    for effect in (cancel(None, HALF), set_parameter(HALF), switch(HALF)):
        bench = rivals(effect, effect)
        bench.react(0, 0, 1)
        bench.succeed(0.25, 1)
        assert bench.react(5, 0, 1) == []
        assert bench.react(6, 1) == ["stop 1", "start 3"]


def test_r15_another_rule_that_does_the_same_answers_only_once_it_has_succeeded() -> None:
    bench = rivals(cancel(None, SECOND), cancel(None, HALF))
    bench.react(0, 0, 1)
    assert bench.react(0.5, 0, 1) == ["failed 3", "start 2"]


def test_r15_a_success_of_the_same_look_answers() -> None:
    plans = Plans()
    plans.rule([plans.task(cancel(None, HALF), otherwise=[plans.task(log())])])  # 1, then 0
    plans.rule([plans.task(cancel(None, HALF))])  # 2
    bench = ReactorBench(plans, order=(1, 0))
    bench.react(0, 0, 1)
    assert bench.succeed(0.5, 2) == []
    assert bench.state(1) is TaskState.WAITING


def test_r15_another_rule_that_does_something_else_as_well_does_not_answer() -> None:
    plans = Plans()
    plans.rule([plans.task(cancel(None, HALF))], [plans.task(send())])
    plans.rule([plans.task(cancel(None, HALF), otherwise=[plans.task(log())])])  # 3, then 2
    bench = ReactorBench(plans)
    bench.react(0, 0, 1)
    bench.succeed(0.25, 0)
    assert bench.react(0.5, 0, 1) == ["failed 3", "start 2"]


def test_r15_another_value_does_not_answer() -> None:
    true = reactions.SetParameter("/planner", "speed", True, HALF)
    one = reactions.SetParameter("/planner", "speed", 1.0, HALF)
    bench = rivals(true, one)
    bench.react(0, 0, 1)
    bench.succeed(0.25, 1)
    assert bench.react(0.5, 0, 1) == ["failed 3", "start 2"]


def test_r15_what_has_failed_so_starts_again_when_its_rule_owns_the_resource() -> None:
    bench = overruled_cancel()
    bench.react(0, 0, 1)
    bench.react(0.5, 0, 1)
    assert bench.react(1, 1) == ["stop 1", "start 3"]
    assert bench.state(2) is TaskState.DONE
    assert bench.react(1.5, 1) == ["failed 3"], "what follows has followed already"
    assert bench.react(2) == []


def test_r15_what_has_failed_so_is_not_stopped() -> None:
    bench = overruled_cancel()
    bench.react(0, 0, 1)
    bench.react(0.5, 0, 1)
    assert bench.react(1, 0) == []
    assert bench.react(2, 0, 1) == ["overruled 3 by 0"]


def test_r15_what_has_failed_so_does_not_hold_up_its_plan() -> None:
    plans = Plans()
    plans.rule([plans.task(send(timeout_ns=10 * SECOND))])
    slow = plans.task(send(timeout_ns=10 * SECOND), resource=1)
    plans.rule([plans.task(cancel(None, HALF)), slow], [plans.task(log())])  # 2 and 1, then 3
    bench = ReactorBench(plans)
    bench.react(0, 0, 1)
    assert bench.react(0.5, 0, 1) == ["failed 2"]
    assert bench.succeed(1, slow) == ["start 3"]


def test_r15_an_escalation_that_waits_in_vain_fails_as_well() -> None:
    plans = Plans()
    plans.rule([plans.task(send(timeout_ns=10 * SECOND))])
    halt = plans.task(cancel(None, HALF), otherwise=[plans.task(log())])  # 2, then 1
    plans.rule([plans.task(send(timeout_ns=HALF), resource=1, otherwise=[halt])])
    bench = ReactorBench(plans)
    bench.react(0, 0, 1)
    assert bench.react(0.5, 0, 1) == ["failed 3", "overruled 2 by 0"]
    assert bench.react(1, 0, 1) == ["failed 2", "start 1"]


def lamps() -> ReactorBench:
    """Two rules that publish at a rate, the second with a line of the log behind its `else`."""
    plans = Plans()
    plans.rule([plans.task(publish(SECOND))])
    plans.rule([plans.task(publish(SECOND, 1), otherwise=[plans.task(log())])])  # 2, then 1
    return ReactorBench(plans)


def test_r15_what_nobody_awaits_fails_at_once_if_something_follows() -> None:
    bench = lamps()
    assert bench.react(0, 0, 1) == ["start 0", "overruled 2 by 0", "failed 2", "start 1"]
    assert bench.react(1, 1) == ["stop 0", "start 2"]
    assert bench.react(2, 0, 1) == ["overruled 2 by 0", "failed 2", "start 0"]


def test_r15_what_nobody_awaits_waits_if_nothing_follows() -> None:
    plans = Plans()
    for number in range(2):
        plans.rule([plans.task(publish(SECOND, number))])
    bench = ReactorBench(plans)
    bench.react(0, 0, 1)
    assert bench.react(1000, 0, 1) == []
    assert bench.reactor.states == (TaskState.HOLDING, TaskState.WAITING)


def test_r15_ends_of_what_runs_come_before_those_of_what_waits() -> None:
    plans = Plans()
    plans.rule([plans.task(cancel(None, HALF))])
    plans.rule([plans.task(send(timeout_ns=HALF))])
    bench = ReactorBench(plans, order=(1, 0))
    bench.react(0, 0, 1)
    assert bench.react(0.5, 0, 1) == ["failed 1", "failed 0"]
