"""Time: rules R13 and R14 of docs/explanation/reactions.md."""

import math

from rossmarie import ir
from rossmarie.interpreter import Reactor
from support.drafts import SECOND
from support.plans import Plans, ReactorBench, call, cancel, limit, log, send


def test_r13_the_next_wake_is_the_end_of_the_first_task_to_run_out_of_time() -> None:
    plans = Plans()
    plans.rule([plans.task(call(3 * SECOND)), plans.task(log())])
    plans.rule([plans.task(call(SECOND), resource=1)])
    bench = ReactorBench(plans)
    assert bench.wake() is None
    bench.react(0, 0)
    assert bench.wake() == 3
    bench.react(1, 0, 1)
    assert bench.wake() == 2
    bench.succeed(1.5, 2)
    assert bench.wake() == 3
    bench.react(2)
    assert bench.wake() is None


def waiting() -> ReactorBench:
    """Task 1 waits from 100 s on, and has three seconds for that."""
    plans = Plans()
    plans.rule([plans.task(send(timeout_ns=10 * SECOND))])
    plans.rule([plans.task(cancel(None, 3 * SECOND))])
    bench = ReactorBench(plans)
    bench.react(100, 0, 1)
    return bench


def test_r13_what_waits_runs_out_of_time_as_well() -> None:
    assert waiting().wake() == 103


def test_r13_what_is_over_and_answered_for_wakes_nobody() -> None:
    plans = Plans()
    plans.rule([plans.task(cancel())])
    plans.rule([plans.task(cancel())])
    bench = ReactorBench(plans)
    bench.react(0, 0, 1)
    bench.succeed(1, 0)
    assert bench.wake() == 2
    bench.react(2, 0, 1)
    assert bench.wake() is None


def test_r14_what_waits_keeps_the_time_that_it_has_left() -> None:
    bench = waiting()
    bench.react(101, 0, 1)
    assert bench.react(50, 0, 1) == []
    assert bench.wake() == 52
    assert bench.react(52, 0, 1) == ["failed 1"]


def test_r14_a_task_keeps_the_time_that_it_has_left() -> None:
    plans = Plans()
    plans.rule([plans.task(call(3 * SECOND))])
    bench = ReactorBench(plans)
    bench.react(100, 0)
    bench.react(101, 0)
    assert bench.react(50, 0) == []
    assert bench.wake() == 52
    assert bench.react(52, 0) == ["failed 0"]


def test_r14_a_limit_goes_on_from_where_it_was() -> None:
    plans = Plans()
    plans.rule([plans.task(limit(-1.0, 1.0, ramp=0.5))])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    bench.react(100)
    bench.react(102)
    bench.react(50)
    assert bench.bounds(50) == (1.0, -2.0, 2.0)
    assert bench.bounds(52) == (1.0, -3.0, 3.0)


def test_r14_ages_do_not_overflow_however_often_time_jumps() -> None:
    plans = Plans()
    plans.rule([plans.task(limit(-1.0, 1.0, ramp=5e-324))])
    reactor = Reactor(plans.machine().reactions)
    reactor.react(0, [True], [])
    reactor.react(0, [False], [])
    for _ in range(3):
        reactor.react(ir.LATEST_NS - 1, [False], [])
        reactor.react(ir.EARLIEST_NS + 1, [False], [])
    (force,) = reactor._filter._forces.values()
    assert force.lifted_ns == ir.EARLIEST_NS + 1 - ir.LONGEST_NS
    reactor.open()
    assert math.isfinite(reactor.bounds(ir.LATEST_NS - 1, 0)[0].high)
