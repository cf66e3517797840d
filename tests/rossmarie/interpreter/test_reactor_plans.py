"""Plans: rules R1, R3 to R6 and R9 of docs/explanation/reactions.md."""

import pytest

from rossmarie import ir
from rossmarie.interpreter import Reactor, TaskState
from rossmarie.ir import TruthValue
from support.drafts import SECOND
from support.plans import (
    Plans,
    ReactorBench,
    call,
    cancel,
    diagnose,
    limit,
    log,
    publish,
    send,
    set_parameter,
)


def test_r1_task_commands_of_one_instant_come_in_the_order_of_the_rules_of_this_page() -> None:
    plans = Plans()
    plans.rule([plans.task(publish(SECOND))])  # 0: stops
    plans.rule([plans.task(publish(SECOND, 1))])  # 1: gets what 0 had
    plans.rule([plans.task(diagnose())], [plans.task(log())])  # 2, 3: starts, and goes on
    plans.rule([plans.task(call(), resource=1, otherwise=[plans.task(log())])])  # 5, then 4: fails
    bench = ReactorBench(plans, order=(0, 1, 2, 3))
    bench.react(0, 0, 1, 3)
    assert bench.react(2, 1, 2, 3) == [
        "stop 0", "start 1", "start 2", "failed 5", "start 4", "start 3",
    ]  # fmt: skip


def test_r1_a_rule_gives_way_to_others_that_are_active() -> None:
    plans = Plans()
    plans.rule([plans.task(diagnose())], unless=[1, 2])
    plans.rule([plans.task(diagnose())], unless=[2])
    plans.rule([plans.task(diagnose())])
    bench = ReactorBench(plans)
    assert bench.react(0, 0) == ["start 0"]
    assert bench.react(1, 0, 1) == ["stop 0", "start 1"]
    assert bench.react(2, 0, 1, 2) == ["stop 1", "start 2"]
    assert bench.react(3, 0) == ["stop 2", "start 0"]


def test_r1_looking_twice_is_looking_once() -> None:
    plans = Plans()
    plans.rule([plans.task(diagnose()), plans.task(call())])
    bench = ReactorBench(plans)
    assert bench.react(1, 0) != []
    assert bench.react(1, 0) == []


@pytest.mark.parametrize("at_ns", [ir.EARLIEST_NS, ir.LATEST_NS])
def test_r1_instants_out_of_range_are_refused(at_ns: int) -> None:
    plans = Plans()
    task = plans.task(call())
    plans.rule([task])
    reactor = Reactor(plans.machine().reactions)
    with pytest.raises(ValueError, match="out of range"):
        reactor.react(at_ns, [True], [])
    with pytest.raises(ValueError, match="out of range"):
        reactor.report(at_ns, task, True, [])
    assert reactor.states == (TaskState.IDLE,)


def test_r3_the_first_stage_starts_in_order() -> None:
    plans = Plans()
    last, first = plans.task(diagnose()), plans.task(call())
    plans.rule([first, last], [plans.task(log())])
    assert ReactorBench(plans).react(0, 0) == [f"start {first}", f"start {last}"]


def test_r3_an_engaged_rule_starts_once() -> None:
    plans = Plans()
    plans.rule([plans.task(diagnose())])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    assert bench.react(1, 0) == []


def test_r3_a_rule_begins_anew() -> None:
    plans = Plans()
    plans.rule([plans.task(log())], [plans.task(diagnose())])
    bench = ReactorBench(plans)
    assert bench.react(0, 0) == ["start 0", "start 1"]
    assert bench.react(1) == ["stop 1"]
    assert bench.react(2, 0) == ["start 0", "start 1"]


def test_r4_effects_that_nobody_awaits_are_done_at_once() -> None:
    plans = Plans()
    plans.rule([plans.task(log()), plans.task(limit(-1.0, 1.0))])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    assert bench.reactor.states == (TaskState.DONE, TaskState.HOLDING)


def test_r4_awaited_effects_run_until_success_is_reported() -> None:
    plans = Plans()
    plans.rule([plans.task(call()), plans.task(set_parameter(), resource=1)])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    assert bench.reactor.states == (TaskState.RUNNING, TaskState.RUNNING)
    assert [*bench.succeed(1, 0), *bench.succeed(1, 1)] == []
    assert bench.reactor.states == (TaskState.DONE, TaskState.HOLDING)


def test_r4_the_last_instant_is_in_time() -> None:
    plans = Plans()
    plans.rule([plans.task(call(2 * SECOND))])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    assert bench.succeed(2, 0) == []
    assert bench.state(0) is TaskState.DONE


def test_r4_what_comes_later_is_too_late() -> None:
    plans = Plans()
    plans.rule([plans.task(call(2 * SECOND)), plans.task(cancel(0, 2 * SECOND), resource=1)])
    bench = ReactorBench(plans, watches=1)
    bench.react(0, 0)
    bench.succeed(1, 1)
    bench.watches[0] = TruthValue.TRUE
    assert bench.succeed(2.000000001, 0) == ["failed 0", "failed 1"]


def test_r4_a_confirmation_has_to_be_true_as_well() -> None:
    plans = Plans()
    plans.rule([plans.task(cancel(confirmation=0))], [plans.task(log())])
    bench = ReactorBench(plans, watches=1)
    bench.react(0, 0)
    bench.watches[0] = TruthValue.FALSE
    assert bench.succeed(0.5, 0) == []
    bench.watches[0] = TruthValue.TRUE
    assert bench.react(1, 0) == ["start 1"]
    bench.watches[0] = TruthValue.FALSE
    assert bench.react(1.5, 0) == []
    assert bench.state(0) is TaskState.HOLDING


@pytest.mark.parametrize("unknown", [TruthValue.UNKNOWN, TruthValue.STALE])
def test_r4_a_confirmation_that_is_unknown_confirms_nothing(unknown: TruthValue) -> None:
    plans = Plans()
    plans.rule([plans.task(cancel(confirmation=0, timeout_ns=SECOND))])
    bench = ReactorBench(plans, watches=1)
    bench.react(0, 0)
    bench.watches[0] = unknown
    bench.succeed(0.5, 0)
    assert bench.react(1, 0) == ["failed 0"]


def test_r5_the_next_stage_starts_when_all_tasks_have_passed() -> None:
    plans = Plans()
    plans.rule([plans.task(call()), plans.task(send(), resource=1)], [plans.task(log())])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    assert bench.succeed(1, 1) == []
    assert bench.succeed(1, 0) == ["start 2"]


def test_r5_stages_that_are_done_at_once_follow_at_one_instant() -> None:
    plans = Plans()
    plans.rule([plans.task(log())], [plans.task(diagnose())], [plans.task(call())])
    assert ReactorBench(plans).react(0, 0) == ["start 0", "start 1", "start 2"]


def test_r5_a_failure_keeps_the_plan_at_its_stage() -> None:
    plans = Plans()
    failing = plans.task(call(), otherwise=[plans.task(log())])
    plans.rule([failing], [plans.task(diagnose())])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    assert bench.fail(1, failing) == [f"failed {failing}", "start 0"]
    assert bench.react(9, 0) == []


def test_r6_escalations_start_when_a_task_fails() -> None:
    plans = Plans()
    failing = plans.task(call(), otherwise=[plans.task(log()), plans.task(diagnose())])
    plans.rule([failing])
    bench = ReactorBench(plans)
    assert bench.react(0, 0) == [f"start {failing}"]
    assert bench.fail(1, failing) == [f"failed {failing}", "start 0", "start 1"]
    assert bench.react(2) == ["stop 1"]


def test_r6_escalations_can_fail() -> None:
    plans = Plans()
    second = plans.task(call(SECOND), otherwise=[plans.task(log())])
    first = plans.task(call(SECOND), resource=1, otherwise=[second])
    plans.rule([first])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    assert bench.react(1, 0) == [f"failed {first}", f"start {second}"]
    assert bench.react(2, 0) == [f"failed {second}", "start 0"]


def test_r6_other_tasks_go_on() -> None:
    plans = Plans()
    failing, other = plans.task(call()), plans.task(call(), resource=1)
    plans.rule([failing, other])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    bench.fail(1, failing)
    assert bench.state(other) is TaskState.RUNNING
    assert bench.succeed(1, other) == []
    assert bench.reactor.states == (TaskState.FAILED, TaskState.DONE)


def test_r6_running_out_of_time_is_a_failure() -> None:
    plans = Plans()
    plans.rule([plans.task(call(2 * SECOND))])
    bench = ReactorBench(plans)
    bench.react(1, 0)
    assert bench.react(2.999999999, 0) == []
    assert bench.react(3, 0) == ["failed 0"]


def test_r6_reports_about_tasks_that_do_not_run_are_ignored() -> None:
    plans = Plans()
    plans.rule([plans.task(call())], [plans.task(diagnose()), plans.task(publish(), resource=1)])
    bench = ReactorBench(plans)
    assert bench.succeed(0, 0) == []  # not started
    bench.react(1, 0)
    bench.succeed(2, 0)
    for task in range(3):
        assert bench.fail(3, task) == []  # done
    assert bench.reactor.states == (TaskState.DONE, TaskState.HOLDING, TaskState.DONE)
    bench.react(4)
    assert bench.fail(5, 0) == []  # forgotten


def test_r9_what_is_in_force_stops_last_started_first() -> None:
    plans = Plans()
    plans.rule([plans.task(diagnose()), plans.task(limit(-1.0, 1.0))], [plans.task(call())])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    assert bench.react(1) == ["stop 2", "stop 1", "stop 0"]
    assert set(bench.reactor.states) == {TaskState.IDLE}


def test_r9_what_is_done_or_failed_is_not_stopped() -> None:
    plans = Plans()
    plans.rule([plans.task(log()), plans.task(call())])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    bench.fail(1, 1)
    assert bench.react(2) == []


def test_r9_a_task_that_started_again_counts_as_started_last() -> None:
    plans = Plans()
    plans.rule([plans.task(publish(SECOND))])
    plans.rule([plans.task(publish(SECOND, 1)), plans.task(diagnose())])
    bench = ReactorBench(plans)
    bench.react(0, 1)
    bench.react(1, 0, 1)
    bench.react(2, 1)
    assert bench.react(3) == ["stop 1", "stop 2"]
