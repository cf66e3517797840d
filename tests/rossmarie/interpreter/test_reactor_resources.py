"""Resources: rules R2, R7 and R8 of docs/explanation/reactions.md."""

from rossmarie.interpreter import TaskState
from rossmarie.ir import reactions
from rossmarie.ir.reactions import Interrupted
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


def test_r2_the_first_engaged_rule_owns_what_it_needs_anywhere_in_its_plan() -> None:
    plans = Plans()
    far = plans.task(call(), resource=1, otherwise=[plans.task(publish())])
    plans.rule([plans.task(publish(SECOND))])  # 2
    plans.rule([far])
    bench = ReactorBench(plans, order=(1, 0))
    assert bench.react(0, 0) == ["start 2"]
    assert bench.react(1, 0, 1) == ["overruled 2 by 1", f"start {far}"]
    assert ReactorBench(plans, order=(0, 1)).react(0, 0, 1) == ["start 2", f"start {far}"]


def test_r2_what_needs_nothing_is_shared() -> None:
    plans = Plans()
    plans.rule([plans.task(limit(-1.0, 1.0)), plans.task(diagnose())])
    plans.rule([plans.task(limit(-1.0, 1.0)), plans.task(diagnose())])
    bench = ReactorBench(plans)
    bench.react(0, 0, 1)
    assert set(bench.reactor.states) == {TaskState.HOLDING}


def test_r2_one_rule_may_use_its_resource_twice() -> None:
    plans = Plans()
    plans.rule([plans.task(cancel())], [plans.task(send())])
    bench = ReactorBench(plans)
    bench.react(0, 0)
    assert bench.succeed(1, 0) == ["start 1"]
    assert bench.reactor.states == (TaskState.HOLDING, TaskState.RUNNING)


def test_r2_what_publishes_the_same_is_shared() -> None:
    plans = Plans()
    plans.rule([plans.task(publish(SECOND))])
    plans.rule([plans.task(publish(SECOND))])
    bench = ReactorBench(plans)
    assert bench.react(0, 0, 1) == ["start 0", "start 1"]
    assert bench.react(1, 1) == ["stop 0"]
    assert bench.state(1) is TaskState.HOLDING


def test_r2_what_publishes_something_else_as_well_overrules() -> None:
    plans = Plans()
    plans.rule([plans.task(publish(SECOND)), plans.task(publish(None, 1))])
    plans.rule([plans.task(publish(SECOND))])
    bench = ReactorBench(plans)
    assert bench.react(0, 0, 1) == ["start 0", "start 1", "overruled 2 by 0"]


def test_r2_the_first_rule_decides_about_those_that_publish_the_same() -> None:
    plans = Plans()
    for number in (0, 1, 0):
        plans.rule([plans.task(publish(SECOND, number))])
    bench = ReactorBench(plans)
    assert bench.react(0, 0, 1, 2) == ["start 0", "overruled 1 by 0", "start 2"]
    assert bench.react(1, 1, 2) == ["stop 0", "overruled 2 by 1", "start 1"]


def test_r2_commands_and_what_is_done_are_not_shared() -> None:
    command = reactions.Publish("/command_0", "geometry_msgs/Twist", (), SECOND, 0)
    for effect in (command, set_parameter(), cancel(), call()):
        plans = Plans()
        for _ in range(2):
            plans.rule([plans.task(effect)])
        assert "overruled 1 by 0" in ReactorBench(plans).react(0, 0, 1)


def test_r7_a_task_that_waits_does_not_hold_up_its_plan() -> None:
    plans = Plans()
    plans.rule([plans.task(set_parameter())])
    plans.rule([plans.task(set_parameter())], [plans.task(log())])
    bench = ReactorBench(plans)
    assert bench.react(0, 0, 1) == ["start 0", "overruled 1 by 0", "start 2"]
    assert bench.state(1) is TaskState.WAITING


def test_r7_a_task_that_does_not_wait_fails() -> None:
    plans = Plans()
    plans.rule([plans.task(call())])
    plans.rule([plans.task(call(), otherwise=[plans.task(log())])])  # 2, then 1
    bench = ReactorBench(plans)
    assert bench.react(0, 0, 1) == ["start 0", "overruled 2 by 0", "failed 2", "start 1"]


def test_r8_what_waits_starts_again_when_its_rule_owns_the_resource() -> None:
    plans = Plans()
    for number in range(3):
        plans.rule([plans.task(publish(SECOND, number))])
    bench = ReactorBench(plans)
    assert bench.react(0, 2) == ["start 2"]
    assert bench.react(1, 1, 2) == ["overruled 2 by 1", "start 1"]
    assert bench.react(2, 0, 1, 2) == ["overruled 1 by 0", "start 0"]
    assert bench.react(3, 0, 2) == []  # what waits is not stopped
    assert bench.react(4, 2) == ["stop 0", "start 2"]


def test_r8_what_runs_and_does_not_wait_fails() -> None:
    plans = Plans()
    plans.rule([plans.task(call())])
    plans.rule([plans.task(call(), otherwise=[plans.task(log())])])  # 2, then 1
    bench = ReactorBench(plans)
    bench.react(0, 1)
    assert bench.react(1, 0, 1) == ["overruled 2 by 0", "failed 2", "start 1", "start 0"]
    assert bench.react(2, 1) == ["stop 0"]


def test_r8_what_holds_and_does_not_wait_is_done() -> None:
    plans = Plans()
    plans.rule([plans.task(send())])
    plans.rule([plans.task(send(Interrupted.RESEND))])
    bench = ReactorBench(plans)
    bench.react(0, 1)
    bench.succeed(1, 1)
    assert bench.state(1) is TaskState.HOLDING
    assert bench.react(2, 0, 1) == ["overruled 1 by 0", "start 0"]
    assert bench.state(1) is TaskState.DONE
    assert bench.react(3) == ["stop 0"]


def test_r8_all_is_given_up_before_anything_follows_from_it() -> None:
    plans = Plans()
    plans.rule([plans.task(call()), plans.task(call(), resource=1)])
    first = plans.task(call(), otherwise=[plans.task(log())])
    second = plans.task(call(), resource=1, otherwise=[plans.task(log())])
    plans.rule([first, second])
    bench = ReactorBench(plans)
    bench.react(0, 1)
    assert bench.react(1, 0, 1)[:6] == [
        f"overruled {first} by 0", f"overruled {second} by 0",
        f"failed {first}", "start 2", f"failed {second}", "start 4",
    ]  # fmt: skip
