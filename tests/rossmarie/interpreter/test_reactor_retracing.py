"""Memories of poses, and the sending of them (rules R16 and R17)."""

from __future__ import annotations

from rossmarie import ir
from rossmarie.interpreter import Reactor, TaskState
from rossmarie.ir import TaskCommandKind, reactions
from support.bench import ns
from support.drafts import SECOND
from support.plans import Plans, publish, retrace

NAN = float("nan")


def memory(most: int = 3, apart: float = 1.0, apart_ns: int = 0) -> reactions.Memory:
    """Positions."""
    return reactions.Memory((0, 1, 2), most, apart, apart_ns)


class Bench:
    """A reactor that retraces. Positions are numbers along x."""

    def __init__(self, plans: Plans, *memories: reactions.Memory) -> None:
        machine = plans.machine(memories=memories)
        self.reactor = Reactor(machine.reactions)
        self._rules = len(plans.plans)

    def react(self, seconds: float, x: float, *engaged: int, y: float = 0.0) -> list[str]:
        """The task commands, if these rules are engaged: a pose is reported as its x."""
        which = [rule in engaged for rule in range(self._rules)]
        task_commands = self.reactor.react(ns(seconds), which, [], [x, y, 0.0])
        return [_words(command) for command in task_commands]

    def goes(self, *places: float, since: float = 0.0) -> None:
        """The robot is at each place, a second after the one before."""
        for number, x in enumerate(places):
            assert self.react(since + number, x) == []

    def sends(self, seconds: float, *engaged: int) -> list[float]:
        """The poses that are sent until nothing is left to send, from an instant on."""
        found = []
        at_ns: int | None = ns(seconds)
        which = [rule in engaged for rule in range(self._rules)]
        while at_ns is not None:
            task_commands = self.reactor.react(at_ns, which, [], [99.0, 0.0, 0.0])
            found += [
                command.pose[0]
                for command in task_commands
                if command.kind is TaskCommandKind.RETRACE
            ]
            at_ns = self.reactor.next_wake()
        return found


def _words(command: ir.TaskCommand) -> str:
    if command.kind is TaskCommandKind.RETRACE:
        return f"retrace {command.task} to {command.pose[0]:g}"
    return f"{command.kind.value} {command.task}" + (
        "" if command.by is None else f" by {command.by}"
    )


def bench(*memories: reactions.Memory, period_ns: int = SECOND) -> Bench:
    """One rule that retraces."""
    plans = Plans()
    plans.rule([plans.task(retrace(period_ns))])
    return Bench(plans, *(memories or (memory(),)))


def test_r16_poses_are_recorded_that_are_far_enough_from_the_last_one() -> None:
    one = bench(memory(most=9))
    one.goes(0.0, 0.5, 0.99, 1.0, 1.5, 2.5, 2.5, 1.6, 1.5)
    assert one.sends(20, 0) == [1.5, 2.5, 1.0, 0.0]


def test_r16_the_distance_is_that_of_positions() -> None:
    one = bench(memory(most=9))
    assert one.react(0, 0.0) == []
    assert one.react(1, 0.59, y=0.8) == []
    assert one.react(2, 0.6, y=0.8) == []
    assert one.sends(5, 0) == [0.6, 0.0]


def test_r16_poses_may_have_to_be_apart_in_time_as_well() -> None:
    one = bench(memory(most=9, apart=0.0, apart_ns=2 * SECOND))
    one.goes(0.0, 1.0, 2.0, 3.0, 3.5, 3.5, 3.5)
    assert one.sends(10, 0) == [3.5, 2.0, 0.0]


def test_r16_a_pose_that_is_not_known_is_not_recorded() -> None:
    one = bench()
    one.goes(0.0, NAN, float("inf"), 1.0)
    assert one.react(5, 5.0, y=NAN) == []
    assert one.sends(6, 0) == [1.0, 0.0]


def test_r16_the_oldest_goes_when_a_memory_is_full() -> None:
    one = bench(memory(most=3))
    one.goes(0.0, 1.0, 2.0, 3.0, 4.0)
    assert one.sends(9, 0) == [4.0, 3.0, 2.0]


def test_r16_nothing_is_recorded_while_a_rule_is_carried_out_that_retraces_the_memory() -> None:
    plans = Plans()
    plans.rule([plans.task(retrace())])
    plans.rule([plans.task(publish(SECOND), resource=1)])
    one = Bench(plans, memory())
    one.goes(0.0, 1.0)
    assert one.react(5, 2.0, 0)[0] == "start 0"
    assert one.react(5.5, 3.0, 0) == []
    assert one.react(6, 4.0, 1) == ["stop 0", "start 1"]
    assert one.sends(7, 0) == [4.0, 0.0]


def test_r16_rules_that_give_way_do_not_keep_others_from_recording() -> None:
    plans = Plans()
    plans.rule([plans.task(publish(SECOND), resource=1)])
    plans.rule([plans.task(retrace())], unless=[0])
    one = Bench(plans, memory())
    assert one.react(0, 0.0) == []
    assert one.react(1, 1.0, 0, 1) == ["start 0"]
    assert one.sends(2, 1) == [1.0, 0.0]


def test_r17_the_newest_pose_comes_first_one_in_each_period() -> None:
    one = bench(period_ns=2 * SECOND)
    one.goes(0.0, 1.0, 2.0)
    assert one.react(5, 9.0, 0) == ["start 0", "retrace 0 to 2"]
    assert one.reactor.next_wake() == ns(7)
    assert one.react(6.9, 9.0, 0) == []
    assert one.react(7, 9.0, 0) == ["retrace 0 to 1"]
    assert one.react(12, 9.0, 0) == ["retrace 0 to 0"]
    assert one.reactor.next_wake() is None
    assert one.reactor.states == (TaskState.HOLDING,)


def test_r17_looking_twice_sends_once() -> None:
    one = bench()
    one.goes(0.0, 1.0, 2.0)
    assert one.react(5, 9.0, 0) == ["start 0", "retrace 0 to 2"]
    assert one.react(5, 9.0, 0) == []


def test_r17_what_was_sent_is_gone_and_the_rest_stays() -> None:
    one = bench()
    one.goes(0.0, 1.0, 2.0)
    assert one.react(5, 9.0, 0) == ["start 0", "retrace 0 to 2"]
    assert one.react(5.5, 2.1) == ["stop 0"]
    assert one.react(6, 9.0, 0) == ["start 0", "retrace 0 to 2.1"]
    assert one.sends(7, 0) == [1.0, 0.0]


def test_r17_nothing_is_sent_while_the_pose_is_not_known() -> None:
    one = bench()
    one.goes(0.0, 1.0, 2.0)
    assert one.react(5, NAN, 0) == ["start 0"]
    assert one.reactor.next_wake() is None
    assert one.react(6, 9.0, 0) == ["retrace 0 to 2"]
    assert one.react(7, 9.0, 0, y=float("inf")) == []
    assert one.react(7.5, 9.0, 0) == ["retrace 0 to 1"]


def test_r17_an_empty_memory_sends_nothing() -> None:
    one = bench()
    assert one.react(0, 0.0, 0) == ["start 0"]
    assert one.reactor.next_wake() is None


def test_r17_the_rule_that_owns_the_topic_sends() -> None:
    plans = Plans()
    plans.rule([plans.task(retrace())])
    plans.rule([plans.task(retrace())])
    one = Bench(plans, memory())
    one.goes(0.0, 1.0, 2.0)
    assert one.react(5, 9.0, 1) == ["start 1", "retrace 1 to 2"]
    found = one.react(5.5, 9.0, 0, 1)
    assert found == ["overruled 1 by 0", "start 0", "retrace 0 to 1"]
    assert one.react(6, 9.0, 1) == ["stop 0", "start 1", "retrace 1 to 0"]


def test_r17_two_topics_share_what_a_memory_has() -> None:
    plans = Plans()
    tasks = [plans.task(retrace()), plans.task(retrace(topic="/other"), resource=1)]
    plans.rule(tasks)
    one = Bench(plans, memory())
    one.goes(0.0, 1.0, 2.0)
    assert one.react(5, 9.0, 0) == ["start 0", "start 1", "retrace 0 to 2", "retrace 1 to 1"]


def test_r16_periods_and_times_apart_keep_their_age_when_time_jumps_back() -> None:
    one = bench(memory(most=9, apart=0.0, apart_ns=2 * SECOND), period_ns=2 * SECOND)
    one.goes(0.0, 1.0, 2.0)
    assert one.react(0.5, 3.0) == []  # a second and a half before: the last one is as old as it was
    assert one.react(2.4, 4.0) == []
    assert one.react(2.5, 5.0) == []
    assert one.react(9, 9.0, 0) == ["start 0", "retrace 0 to 5"]
    assert one.react(4, 9.0, 0) == []
    assert one.react(5.9, 9.0, 0) == []
    assert one.react(6, 9.0, 0) == ["retrace 0 to 2"]
