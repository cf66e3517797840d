"""The effects that rules would have had, from the events of a monitor alone."""

from __future__ import annotations

from collections.abc import Sequence

from hypothesis import given
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.ir import Change, Event, TaskCommandKind, TimeJump, Verdict
from rossmarie.report.rehearsal import Rehearsed, TaskSummary, rehearse, summarize_tasks
from support.docking import docking
from support.drafts import SECOND
from support.plans import Plans, call, cancel, log, publish, reported, send
from support.reacting import reacting_machines


def verdict(at_s: int, rule: int, change: Change) -> Verdict:
    return Verdict(rule, at_s * SECOND, change, (), (), (), ())


def on(at_s: int, rule: int) -> Verdict:
    return verdict(at_s, rule, Change.ACTIVATED)


def off(at_s: int, rule: int) -> Verdict:
    return verdict(at_s, rule, Change.CLEARED)


def task_commands(plans: Plans, *events: Event, watches: int = 0) -> list[str]:
    rehearsed = rehearse(plans.machine(watches=watches), events)
    return reported([each.command for each in rehearsed])


def lamps() -> Plans:
    """Two rules that publish on one topic, the first first."""
    plans = Plans()
    for number in range(2):
        plans.rule([plans.task(publish(SECOND, number))])
    return plans


def test_a_rule_that_loses_its_resource_waits_for_it() -> None:
    found = task_commands(lamps(), on(1, 1), on(2, 0), off(3, 0), off(4, 1))
    assert found == ["start 1", "overruled 1 by 0", "start 0", "stop 0", "start 1", "stop 1"]


def test_rules_of_one_instant_are_seen_together() -> None:
    assert task_commands(lamps(), on(1, 1), on(1, 0)) == ["start 0", "overruled 1 by 0"]


def test_a_rule_that_changes_twice_at_one_instant_is_seen_twice() -> None:
    assert task_commands(lamps(), on(1, 0), off(1, 0), on(1, 0)) == ["start 0", "stop 0", "start 0"]


def test_what_is_stale_counts_as_active() -> None:
    assert task_commands(lamps(), verdict(1, 0, Change.ACTIVATED_STALE)) == ["start 0"]


def test_what_is_awaited_succeeds_at_once() -> None:
    plans = Plans()
    first, then = plans.task(call()), plans.task(cancel(0))
    plans.rule([first], [then], [plans.task(log())])
    assert task_commands(plans, on(1, 0), watches=1) == ["start 0", "start 1", "start 2"]


def test_time_that_jumps_back_changes_nothing() -> None:
    jump = TimeJump(3 * SECOND, 1 * SECOND)
    assert task_commands(lamps(), on(2, 0), jump, off(2, 0)) == ["start 0", "stop 0"]


def test_rules_without_bodies_do_nothing() -> None:
    plans = Plans()
    plans.rule()
    assert rehearse(plans.machine(), [on(1, 0)]) == ()


def test_a_task_command_knows_its_activation_and_what_it_follows() -> None:
    machine = lamps().machine()
    found = rehearse(machine, [on(1, 1), on(2, 0), off(3, 0), on(4, 0), off(4, 1)])
    places = [(each.rule, each.activation, each.after) for each in found]
    assert places == [(1, 0, 0), (1, 0, 1), (0, 1, 1), (0, 1, 2), (1, 0, 2), (1, 0, 4), (0, 3, 4)]


def test_a_summary_counts_starts_and_who_overruled() -> None:
    replay = docking()
    assert summarize_tasks(replay.machine, replay.rehearsed) == (
        TaskSummary("docking", "creep", "limit /cmd_vel", 1, ()),
        TaskSummary("docking", "creep", "publish /lamp at 2 Hz", 2, (("touching", 1),)),
        TaskSummary("touching", "alarm", "publish /lamp at 10 Hz", 1, ()),
        TaskSummary("touching", "alarm", "call /horn", 1, ()),
        TaskSummary("touching", "stop", "block /cmd_vel", 1, ()),
    )


@st.composite
def histories(draw: st.DrawFn) -> tuple[ir.Machine, list[Event]]:
    """A machine that does something, and verdicts on its rules, often several at one instant."""
    machine = draw(reacting_machines())
    active = [False] * len(machine.rules)
    events: list[Event] = []
    at_s = 0
    for _ in range(draw(st.integers(0, 20))):
        at_s += draw(st.sampled_from((0, 0, 1)))
        rule = draw(st.integers(0, len(active) - 1))
        events.append(off(at_s, rule) if active[rule] else on(at_s, rule))
        active[rule] = not active[rule]
    return machine, events


@given(histories())
def test_only_what_is_overruled_fails(history: tuple[ir.Machine, list[Event]]) -> None:
    overruled: set[tuple[int, int]] = set()
    for each in rehearse(*history):
        if each.command.kind is TaskCommandKind.OVERRULED:
            overruled.add((each.command.task, each.activation))
        elif each.command.kind is TaskCommandKind.FAILED:
            assert (each.command.task, each.activation) in overruled


@given(histories())
def test_every_task_command_belongs_to_an_activation_before_it(
    history: tuple[ir.Machine, list[Event]],
) -> None:
    machine, events = history
    for each in rehearse(machine, events):
        opened = events[each.activation]
        assert isinstance(opened, Verdict)
        assert opened.rule == each.rule
        assert opened.change is not Change.CLEARED
        assert each.activation <= each.after
        assert each.command.task in machine.reactions.plans[each.rule].tasks
        assert has_started_after(each, events)


def has_started_after(each: Rehearsed, events: Sequence[Event]) -> bool:
    """Say whether the rule of a command was active until the event before the command, or was
    cleared at the same instant.
    """
    last = events[each.after]
    assert isinstance(last, Verdict)
    return all(
        event.at_ns == last.at_ns
        for event in events[each.activation : each.after + 1]
        if isinstance(event, Verdict) and event.rule == each.rule and event.change is Change.CLEARED
    )


def test_what_waits_too_long_fails_between_two_events() -> None:
    plans = Plans()
    plans.rule([plans.task(send(timeout_ns=10 * SECOND))])
    plans.rule([plans.task(cancel(), otherwise=[plans.task(log())])])  # 2, then 1
    events = [on(1, 0), on(1, 1), off(9, 1)]
    found = rehearse(plans.machine(), events)
    assert reported([each.command for each in found]) == [
        "start 0", "overruled 2 by 0", "failed 2", "start 1",
    ]  # fmt: skip
    assert [(each.after, each.later_ns) for each in found[2:]] == [(1, 2 * SECOND)] * 2


def test_what_waits_too_long_fails_up_to_the_end_of_the_recording() -> None:
    plans = Plans()
    plans.rule([plans.task(send(timeout_ns=10 * SECOND))])
    plans.rule([plans.task(cancel())])
    events = [on(1, 0), on(1, 1)]
    assert len(rehearse(plans.machine(), events)) == 2
    assert len(rehearse(plans.machine(), events, 3 * SECOND - 1)) == 2
    assert len(rehearse(plans.machine(), events, 3 * SECOND)) == 3


def test_what_waits_too_long_fails_before_time_jumps_back() -> None:
    plans = Plans()
    plans.rule([plans.task(send(timeout_ns=10 * SECOND))])
    plans.rule([plans.task(cancel())])
    for from_s, count in ((2, 2), (3, 3)):
        events: list[Event] = [on(1, 0), on(1, 1), TimeJump(from_s * SECOND, 1 * SECOND)]
        assert len(rehearse(plans.machine(), events)) == count
