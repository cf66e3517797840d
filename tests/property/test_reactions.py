"""Properties of every reactor, for all rules and all events."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from hypothesis import given, settings

from rossmarie import ir
from rossmarie.interpreter import Reactor, TaskState
from rossmarie.ir import TaskCommandKind, TruthValue, reactions
from support.depth import examples
from support.growing import TICK
from support.reacting import Look, ReactingCase, look, reacting_cases

MANY = settings(max_examples=examples(2))
UNAWAITED = (reactions.Publish, reactions.Retrace)
"""Effects that may wait as long as another rule has what they need."""

PASSED = (TaskState.HOLDING, TaskState.WAITING, TaskState.OVERDUE, TaskState.DONE)
IN_FORCE = (TaskState.RUNNING, TaskState.HOLDING)
LACKING = (TaskState.WAITING, TaskState.OVERDUE)
HAS_FAILED = (TaskState.FAILED, TaskState.OVERDUE)


@dataclass(frozen=True)
class Scene:
    """The observations around one event."""

    event: Look
    before: tuple[TaskState, ...]
    task_commands: Sequence[ir.TaskCommand]
    after: tuple[TaskState, ...]
    reactor: Reactor


def scenes(case: ReactingCase) -> Iterator[Scene]:
    reactor = Reactor(case.machine.reactions)
    for number, event in enumerate(case.events):
        if number == case.opens_before:
            reactor.open()
        before = reactor.states
        task_commands = look(reactor, event)
        yield Scene(event, before, task_commands, reactor.states, reactor)


def rules_of_tasks(found: ir.Reactions) -> dict[int, int]:
    return {task: rule for rule, plan in enumerate(found.plans) for task in plan.tasks}


@MANY
@given(reacting_cases())
def test_what_is_in_force_on_a_resource_is_of_one_rule_or_one_message(case: ReactingCase) -> None:
    found = case.machine.reactions
    rules = rules_of_tasks(found)
    for scene in scenes(case):
        for resource in range(len(found.resources)):
            in_force = [
                task
                for task, state in enumerate(scene.after)
                if state in IN_FORCE and found.tasks[task].resource == resource
            ]
            is_one_rule = len({rules[task] for task in in_force}) <= 1
            effects = {found.tasks[task].effect for task in in_force}
            is_one_message = len(effects) == 1 and isinstance(effects.pop(), reactions.Publish)
            assert is_one_rule or is_one_message


@MANY
@given(reacting_cases())
def test_task_commands_fit_what_is_in_force(case: ReactingCase) -> None:
    """Only what was started is stopped or overruled, unless an overruling takes a start's place."""
    for scene in scenes(case):
        in_force = {task for task, state in enumerate(scene.before) if state in IN_FORCE}
        begun = {task for task, state in enumerate(scene.before) if state is not TaskState.IDLE}
        for command in scene.task_commands:
            match command.kind:
                case TaskCommandKind.START:
                    assert command.task not in in_force
                    in_force.add(command.task)
                case TaskCommandKind.STOP:
                    assert command.task in in_force
                    in_force.remove(command.task)
                case TaskCommandKind.OVERRULED:
                    assert command.task in in_force or command.task not in begun
                    in_force.discard(command.task)
                case TaskCommandKind.FAILED:
                    assert scene.after[command.task] in HAS_FAILED
                    in_force.discard(command.task)
                case TaskCommandKind.RETRACE:
                    assert scene.after[command.task] is TaskState.HOLDING
                    assert command.task in in_force
            assert (command.by is not None) == (command.kind is TaskCommandKind.OVERRULED)
        left = {task for task, state in enumerate(scene.after) if state in IN_FORCE}
        assert left == in_force - _done(scene)


def _done(scene: Scene) -> set[int]:
    return {task for task, state in enumerate(scene.after) if state is TaskState.DONE}


@MANY
@given(reacting_cases())
def test_no_task_gets_more_than_two_task_commands_in_one_call(case: ReactingCase) -> None:
    for scene in scenes(case):
        tasks = [command.task for command in scene.task_commands]
        assert max(map(tasks.count, tasks), default=0) <= 2


@MANY
@given(reacting_cases())
def test_nothing_is_left_of_rules_that_are_released(case: ReactingCase) -> None:
    found = case.machine.reactions
    *_, last = scenes(case)
    released = (False,) * len(found.plans)
    task_commands = last.reactor.react(last.event.at_ns, released, last.event.watches)
    assert {command.kind for command in task_commands} <= {TaskCommandKind.STOP}
    in_force = [task for task, state in enumerate(last.after) if state in IN_FORCE]
    assert sorted(command.task for command in task_commands) == in_force
    assert set(last.reactor.states) == {TaskState.IDLE}
    assert last.reactor.next_wake() is None


@MANY
@given(reacting_cases())
def test_a_stage_starts_when_all_before_it_has_passed(case: ReactingCase) -> None:
    """And what has passed never counts as not begun again while the rule is engaged."""
    found = case.machine.reactions
    for scene in scenes(case):
        for plan in found.plans:
            has_begun = [
                any(scene.after[task] is not TaskState.IDLE for task in stage)
                for stage in plan.stages
            ]
            for number, stage in enumerate(plan.stages):
                starts = any(command.task in stage and command.kind is TaskCommandKind.START
                             and scene.before[command.task] is TaskState.IDLE
                             for command in scene.task_commands)  # fmt: skip
                if starts:
                    before = [task for part in plan.stages[:number] for task in part]
                    passed = [scene.after[task] in PASSED for task in before]
                    waited = [scene.before[task] in LACKING for task in before]
                    assert all(one or other for one, other in zip(passed, waited, strict=True))
                if has_begun[number]:
                    assert all(has_begun[k] or not plan.stages[k] for k in range(number))


# --- bounds ----------------------------------------------------------------------------------


def limits_in_force(found: ir.Reactions, states: Sequence[TaskState]) -> Iterator[reactions.Limit]:
    for task, state in zip(found.tasks, states, strict=True):
        if isinstance(task.effect, reactions.Limit) and state in IN_FORCE:
            yield task.effect


@MANY
@given(reacting_cases())
def test_bounds_keep_every_limit_in_force(case: ReactingCase) -> None:
    found = case.machine.reactions
    for number, scene in enumerate(scenes(case)):
        for command in range(len(found.commands)):
            bounds = scene.reactor.bounds(scene.event.at_ns, command)
            for field in bounds:
                assert 0.0 <= field.factor <= 1.0
                assert field.low <= 0.0 <= field.high
                is_open = number >= case.opens_before
                assert is_open or (field.low, field.high) == (0.0, 0.0)
            for limit in limits_in_force(found, scene.after):
                for bound in limit.bounds if limit.topic == command else ():
                    assert bound.low <= bounds[bound.field].low
                    assert bounds[bound.field].high <= bound.high


@MANY
@given(reacting_cases())
def test_bounds_move_apart_no_faster_than_the_fastest_ramp(case: ReactingCase) -> None:
    found = case.machine.reactions
    for scene in scenes(case):
        for command, topic in enumerate(found.commands):
            earlier = scene.reactor.bounds(scene.event.at_ns, command)
            for ticks in (1, 2, 3):
                at_ns = scene.event.at_ns + ticks * TICK // 2
                later = scene.reactor.bounds(at_ns, command)
                for field in range(len(topic.fields)):
                    ramp = _fastest(found, command, field) * (TICK / 2e9)
                    assert _grows(earlier[field].high, later[field].high, ramp)
                    assert _grows(-earlier[field].low, -later[field].low, ramp)
                    assert _grows(earlier[field].factor, later[field].factor, ramp)
                earlier = later


def _fastest(found: ir.Reactions, command: int, field: int) -> float:
    ramps = [0.0]
    for task in found.tasks:
        match task.effect:
            case reactions.Limit(topic=topic, bounds=bounds) if topic == command:
                ramps += [bound.ramp or 0.0 for bound in bounds if bound.field == field]
            case reactions.Scale(topic=topic, ramp=ramp) if topic == command:
                ramps.append(ramp or 0.0)
            case _:
                pass
    return max(ramps)


def _grows(earlier: float, later: float, most: float) -> bool:
    """Say whether a value does not grow by more than a limit, apart from rounding."""
    return earlier <= later <= earlier + most * 1.001 + abs(later) * 1e-12 + 1e-300


# --- time ------------------------------------------------------------------------------------


@MANY
@given(reacting_cases())
def test_looking_once_more_changes_nothing(case: ReactingCase) -> None:
    for scene in scenes(case):
        if scene.event.report is None:
            assert (
                scene.reactor.react(scene.event.at_ns, scene.event.engaged, scene.event.watches)
                == []
            )
            assert scene.reactor.states == scene.after


@MANY
@given(reacting_cases())
def test_a_wake_lies_ahead_and_is_the_end_of_a_task_or_a_pose(case: ReactingCase) -> None:
    effects = [task.effect for task in case.machine.reactions.tasks]
    for scene in scenes(case):
        wake_ns = scene.reactor.next_wake()
        assert wake_ns is not None or TaskState.RUNNING not in scene.after
        assert wake_ns is None or wake_ns > scene.event.at_ns
        has_end = {TaskState.RUNNING, TaskState.WAITING} & set(scene.after)
        retraces = any(
            isinstance(effect, reactions.Retrace) and state is TaskState.HOLDING
            for effect, state in zip(effects, scene.after, strict=True)
        )
        assert wake_ns is None or has_end or retraces


@MANY
@given(reacting_cases())
def test_nothing_waits_in_vain(case: ReactingCase) -> None:
    """After the last event of engaged rules, each task whose resource another rule holds has
    failed, and its escalations have begun. Exceptions are tasks without a time limit, and tasks
    that the other rule runs too.
    """
    found = case.machine.reactions
    *_, last = scenes(case)
    engaged = [True] * len(found.plans)
    unknown = [TruthValue.UNKNOWN] * len(case.machine.watches)
    nowhere = [math.nan] * len(case.machine.readings)
    last.reactor.react(last.event.at_ns, engaged, unknown, nowhere)
    for _ in range(2 * len(found.tasks) + 1):
        if (wake_ns := last.reactor.next_wake()) is None:
            break
        last.reactor.react(wake_ns, engaged, unknown, nowhere)
    states = last.reactor.states
    assert TaskState.RUNNING not in states
    for task, state in zip(found.tasks, states, strict=True):
        if state in HAS_FAILED:
            assert TaskState.IDLE not in [states[other] for other in task.otherwise]
        if state is not TaskState.WAITING or isinstance(task.effect, UNAWAITED):
            assert state is not TaskState.WAITING or not task.otherwise
            continue
        assert not isinstance(task.effect, reactions.CancelGoal) or task.effect.confirmation is None
        assert any(
            type(other.effect) is type(task.effect) and other.resource == task.resource
            for other, held in zip(found.tasks, states, strict=True)
            if held is TaskState.HOLDING
        )
