"""A guard of a policy decides the same in C and in Python, and in a row as by itself."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from rossmarie import ir
from rossmarie.guard import Guard, GuardBatch
from rossmarie.guard.mapping import ArrayMapping
from rossmarie.ir import reactions
from support.c_compiler import needs_c
from support.depth import examples, phases_of_compiled
from support.node_core import NodeCore
from support.policies import PolicyCase, Step, policy_cases, run_policy

pytestmark = needs_c


@pytest.fixture(scope="module", autouse=True)
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


def in_python(case: PolicyCase) -> Guard:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("CC", "no-such-compiler")
        guard = case.guard()
    assert guard.kind == "python"
    return guard


@settings(phases=phases_of_compiled(), max_examples=examples(0.5))
@given(policy_cases())
def test_same_decisions_in_c_and_in_python(case: PolicyCase) -> None:
    native, python = case.guard(), in_python(case)
    assert native.kind == "native"
    for steps in case.episodes:
        assert run_policy(native, steps) == run_policy(python, steps)
        native.restart()
        python.restart()


@settings(phases=phases_of_compiled(), max_examples=examples(0.2))
@given(policy_cases(), st.integers(0, 8))
def test_a_guard_that_is_restored_goes_on_as_the_one_that_was_saved(
    case: PolicyCase, place: int
) -> None:
    for guard, another in ((case.guard(), case.guard()), (in_python(case), in_python(case))):
        for steps in case.episodes:
            guard.restart()
            run_policy(guard, steps[:place])
            state = guard.state()
            wanted = run_policy(guard, steps[place:], is_begun=place > 0)
            for restored in (another, guard):
                restored.restore(state)
                assert run_policy(restored, steps[place:], is_begun=place > 0) == wanted


Found = tuple[bytes, list[list[bool]], list[bool], bytes]


def row_by_row(guards: list[Guard], steps: list[Step]) -> Found:
    """The decisions of guards that know nothing of each other."""
    found = [
        guard.step(step.at_ns, step.observation, step.action)
        for guard, step in zip(guards, steps, strict=True)
    ]
    active = [[rule in decision.active for rule in guards[0].rules] for decision in found]
    actions = np.array([decision.action for decision in found])
    margins = np.array([decision.margin for decision in found])
    changed = [decision.changed for decision in found]
    return actions.tobytes(), active, changed, exact(margins)


def exact(margins: NDArray[np.float64]) -> bytes:
    """All bits of margins, but for those of an unknown one: its sign means nothing."""
    return np.where(np.isnan(margins), np.nan, margins).tobytes()


def in_a_row(batch: GuardBatch, steps: list[Step]) -> Found:
    """The decisions of guards in a row."""
    decided = batch.step(
        np.array([step.at_ns for step in steps]),
        np.array([step.observation for step in steps]),
        np.array([step.action for step in steps]),
    )
    return (
        decided.actions.tobytes(),
        decided.active.tolist(),
        decided.changed.tolist(),
        exact(batch.margin),
    )


@settings(phases=phases_of_compiled(), max_examples=examples(0.2))
@given(policy_cases(), st.lists(st.integers(0, 3), max_size=4))
def test_guards_in_a_row_decide_as_each_by_itself(case: PolicyCase, restarts: list[int]) -> None:
    shortest = min(map(len, case.episodes))
    for guard in (case.guard(), in_python(case)):
        batch, alone = guard.batch(len(case.episodes)), [case.guard() for _ in case.episodes]
        for number in range(shortest):
            if number in restarts:
                batch.restart(np.arange(len(alone)) == number)
                alone[number].restart()
            steps = [
                replace(steps[number], action=steps[number].action.astype(np.float64))
                for steps in case.episodes
            ]
            assert in_a_row(batch, steps) == row_by_row(alone, steps)


def in_two_calls(batch: GuardBatch, steps: list[Step], which: list[bool]) -> Found:
    """The same, with observations before actions, and the rows of a mask before the others."""
    times = np.array([step.at_ns for step in steps])
    observations = np.array([step.observation for step in steps])
    actions = np.array([step.action for step in steps])
    changed = np.zeros(len(steps), np.bool_)
    for mask in (np.array(which), ~np.array(which)):
        active = batch.observe(times, observations, mask)
        passing = batch.allows(actions) if mask.all() else None
        decided = batch.decide(actions, mask)
        actions = decided.actions
        changed |= decided.changed
        if passing is not None:
            assert (passing.diagonal() <= ~changed).all()
    return actions.tobytes(), active.tolist(), changed.tolist(), exact(batch.margin)


@settings(phases=phases_of_compiled(), max_examples=examples(0.2))
@given(policy_cases(), st.lists(st.booleans(), min_size=4, max_size=4))
def test_observations_and_actions_in_two_calls_give_the_same(
    case: PolicyCase, which: list[bool]
) -> None:
    for guard in (case.guard(), in_python(case)):
        batch, alone = guard.batch(len(case.episodes)), [case.guard() for _ in case.episodes]
        for number in range(min(map(len, case.episodes))):
            steps = [
                replace(steps[number], action=steps[number].action.astype(np.float64))
                for steps in case.episodes
            ]
            assert in_two_calls(batch, steps, which) == row_by_row(alone, steps)


def publishes_commands(machine: ir.Machine) -> bool:
    effects = (task.effect for task in machine.reactions.tasks)
    return any(isinstance(each, reactions.Publish) and each.command is not None for each in effects)


@settings(phases=phases_of_compiled(), max_examples=examples(0.3))
@given(policy_cases())
def test_a_generated_node_lets_pass_what_a_guard_executes(case: PolicyCase) -> None:
    machine = ir.without_margins(case.machine)
    assume(machine.reactions.commands and not publishes_commands(machine))
    node, guard = NodeCore(machine), case.guard()
    first = case.episodes[0][0]
    mapping = ArrayMapping(machine, case.observe, case.act)
    wiring = mapping.wiring(first.observation.size, first.action.size)
    for steps in case.episodes:
        node.restart()
        guard.restart()
        for number, step in enumerate(steps):
            if number and step.report is not None:
                task, success = step.report
                guard.report(task, success=success)
                node.report(steps[number - 1].at_ns, task, success=success)
            action = step.action.astype(np.float64)
            decision = guard.step(step.at_ns, step.observation, action)
            node.take(step.at_ns, wiring, step.observation)
            passed = node.passed(step.at_ns, wiring, action)
            assert [rule in decision.active for rule in guard.rules] == node.active
            np.testing.assert_array_equal(decision.action, passed)
