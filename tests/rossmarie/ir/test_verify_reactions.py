"""The messages of `verify` about defects in reactions."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import pytest
from hypothesis import given

from rossmarie import ir
from rossmarie.ir import reactions
from support.c99_cases import reacting
from support.drafts import SECOND, Draft
from support.plans import call, cancel, diagnose, limit, log, publish, scale, set_parameter
from support.reacting import reacting_machines

MACHINE = reacting()
FOUND = MACHINE.reactions


def refused(found: ir.Reactions, watches: tuple[int, ...] = MACHINE.watches) -> str:
    with pytest.raises(ir.MalformedMachine) as refusal:
        ir.verify(replace(MACHINE, reactions=found, watches=watches))
    return str(refusal.value)


@given(reacting_machines())
def test_reactions_that_grow_by_the_rules_pass(machine: ir.Machine) -> None:
    ir.verify(machine)


def test_rules_that_do_nothing_pass() -> None:
    ir.verify(replace(MACHINE, reactions=ir.NO_REACTIONS, watches=()))


@pytest.mark.parametrize(
    ("watches", "said"),
    [
        ((99,), "watch 0: there is no proposition 99"),
        ((-1,), "watch 0: there is no proposition -1"),
    ],
)
def test_watches(watches: tuple[int, ...], said: str) -> None:
    assert refused(FOUND, watches) == said


def test_watches_are_not_elementwise() -> None:
    draft = Draft()
    near = draft.above(draft.elements(), 0.5)
    machine = replace(draft.machine(), watches=(near,))
    with pytest.raises(ir.MalformedMachine, match="watch 0: proposition 0 is elementwise"):
        ir.verify(machine)


@pytest.mark.parametrize(
    ("order", "said"),
    [((0,), "order: not each rule once"), ((0, 0), "order: not each rule once"),
     ((0, 2), "order: not each rule once")],
)  # fmt: skip
def test_order(order: tuple[int, ...], said: str) -> None:
    assert refused(replace(FOUND, order=order)) == said


def plan(*stages: tuple[int, ...], tasks: tuple[int, ...]) -> reactions.RecoveryPlan:
    return reactions.RecoveryPlan(stages, tasks)


FIRST, SECOND_PLAN = FOUND.plans


@pytest.mark.parametrize(
    ("plans", "said"),
    [
        ((FIRST,), "plans: not one for each rule"),
        ((plan((0, 1), (2, 3), tasks=(0, 1, 2)), SECOND_PLAN),
         "plan 0: task 3 is not one of its tasks"),
        ((plan((0, 1), (2, 0), tasks=(0, 1, 2)), SECOND_PLAN),
         "plan 0: task 0 begins at two places"),
        ((plan((0, 1), tasks=(0, 1, 2)), SECOND_PLAN), "plan 0: task 2 never begins"),
        ((FIRST, plan((3, 4, 6), tasks=(3, 4, 5, 6))), "plan 1: task 4 begins at two places"),
        ((FIRST, plan((3,), tasks=(3, 4, 5))), "plans: not each task once"),
        ((FIRST, plan((3, 6), tasks=(3, 4, 5, 6, 6))), "plans: not each task once"),
    ],
)  # fmt: skip
def test_plans(plans: tuple[reactions.RecoveryPlan, ...], said: str) -> None:
    assert refused(replace(FOUND, plans=plans)) == said


def with_task(index: int, change: Callable[[reactions.Task], reactions.Task]) -> ir.Reactions:
    tasks = list(FOUND.tasks)
    tasks[index] = change(tasks[index])
    return replace(FOUND, tasks=tuple(tasks))


def test_escalations_that_follow_each_other_in_a_circle() -> None:
    found = with_task(5, lambda task: replace(task, otherwise=(4,)))
    assert refused(found) == "plan 1: task 4 begins at two places"
    alone = replace(found, tasks=(*found.tasks[:3], replace(found.tasks[3], otherwise=()),
                                  *found.tasks[4:]))  # fmt: skip
    assert refused(alone) == "plan 1: task 4 never begins"


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"action": 1}, "there is no action 1"),
        ({"resource": None}, "resource None"),
        ({"resource": 3}, "there is no resource 3"),
        ({"otherwise": (7,)}, "there is no task 7"),
    ],
)
def test_tasks(change: dict[str, object], said: str) -> None:
    found = with_task(3, lambda task: replace(task, **change))  # type: ignore[arg-type]
    assert refused(found) == f"task 3 (CancelGoal): {said}"


def publish_to(command: int) -> reactions.Publish:
    return replace(publish(), command=command)


def assign(value: float) -> reactions.Call:
    return replace(call(), assignments=(reactions.Assignment(("x",), (1.0, value)),))


@pytest.mark.parametrize(
    ("effect", "said"),
    [
        (replace(limit(0.0, 0.0), topic=1), "there is no command 1"),
        (limit(0.0, 0.0, number=2), "there is no field 2"),
        (limit(0.1, 0.5), "[0.1, 0.5] lacks zero"),
        (limit(-0.5, -0.1), "[-0.5, -0.1] lacks zero"),
        (limit(-math.inf, 0.5), "-inf is not finite"),
        (limit(0.0, math.nan), "nan is not finite"),
        (limit(0.0, 1.0, ramp=0.0), "a ramp of 0.0"),
        (limit(0.0, 1.0, ramp=math.inf), "a ramp of inf"),
        (replace(scale(0.5), topic=-1), "there is no command -1"),
        (scale(1.1), "a factor of 1.1"),
        (scale(-0.1), "a factor of -0.1"),
        (scale(math.nan), "a factor of nan"),
        (scale(0.5, ramp=-1.0), "a ramp of -1.0"),
        (publish_to(1), "there is no command 1"),
        (publish(0), "a duration of 0 ns"),
        (call(0), "a duration of 0 ns"),
        (call(ir.LONGEST_NS), f"a duration of {ir.LONGEST_NS} ns"),
        (assign(math.inf), "inf is not finite"),
        (replace(set_parameter(), value=math.nan), "nan is not finite"),
        (cancel(confirmation=1), "there is no watch 1"),
        (replace(diagnose(), level=reactions.Level.DEBUG), "debugging is for logs"),
    ],
)
def test_effects(effect: reactions.Effect, said: str) -> None:
    resource = 0 if reactions.target_of(effect) is not None else None
    found = with_task(0, lambda task: replace(task, effect=effect, resource=resource))
    assert refused(found) == f"task 0 ({type(effect).__name__}): {said}"


def test_what_is_shared_has_no_resource() -> None:
    found = with_task(0, lambda task: replace(task, effect=log(), resource=0))
    assert refused(found) == "task 0 (Log): resource 0"


def test_what_waits_for_seconds_passes() -> None:
    found = with_task(2, lambda task: replace(task, effect=publish(SECOND)))
    ir.verify(replace(MACHINE, reactions=found))
