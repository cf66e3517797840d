"""Random guards of policies: random machines, arrays of all their fields, and what happens."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st
from numpy.typing import NDArray

from rossmarie import ir
from rossmarie.guard import Decision, Guard, Place
from rossmarie.ir import FieldKind, field_names
from support.growing import NUMBERS
from support.guards import guarded_machines
from support.machines import instants, raw

WANTED = (0.0, -0.0, 0.1, -0.3, 1.0, -5.0, 1e300, float("nan"), float("inf"))


@dataclass(frozen=True)
class Step:
    """An instant, an observation, an action, and a task that has ended before."""

    at_ns: int
    observation: NDArray[Any]
    action: NDArray[Any]
    report: tuple[int, bool] | None


@dataclass(frozen=True)
class PolicyCase:
    """A machine, how arrays stand for its fields, and what happens in some episodes."""

    machine: ir.Machine
    observe: Mapping[str, Place]
    act: Mapping[str, Place]
    episodes: list[list[Step]]

    def guard(self) -> Guard:
        """A guard of it."""
        return Guard(self.machine, self.observe, self.act)


@st.composite
def policy_cases(
    draw: st.DrawFn, episodes: int = 4, sizes: st.SearchStrategy[int] | None = None
) -> PolicyCase:
    """Random guards, with some fields that the arrays do not have."""
    machine = draw(_with_margins(draw(guarded_machines())))
    observe, observed = _observed(draw, machine)
    act, acted = _acted(draw, machine)
    steps = [draw(_steps(machine, observed, acted)) for _ in range(episodes)]
    return PolicyCase(machine, observe, act, steps)


@st.composite
def _with_margins(draw: st.DrawFn, machine: ir.Machine) -> ir.Machine:
    """The same machine, where some rules tell a number of theirs as a margin."""
    arrays = ir.element_arrays(machine).signals
    numbers = [
        index
        for index, signal in enumerate(machine.signals)
        if arrays[index] is None
        and ir.kind_of(machine, index) is FieldKind.REAL
        and not isinstance(signal.node, ir.Constant)
    ]
    rules = []
    for rule in machine.rules:
        if draw(st.booleans()) and numbers:
            margin = ir.Margin(draw(st.sampled_from(numbers)), "mm", 1000.0)
            rule = replace(rule, feedback=ir.Feedback(margin=margin))
        rules.append(rule)
    machine = replace(machine, rules=tuple(rules))
    ir.verify(machine)
    return machine


def _observed(draw: st.DrawFn, machine: ir.Machine) -> tuple[dict[str, Place], int]:
    slots, arrays = field_names(machine)
    observe: dict[str, Place] = {}
    size = 0
    for names, slot in zip(slots, machine.slots, strict=True):
        is_there = slot.kind is not FieldKind.TEXT and draw(st.integers(0, 7)) > 0
        observe[min(names)] = size if is_there else None
        size += is_there
    # Texts are no numbers of an observation, and a list is observed as a whole.
    assume(all(array.kind is not FieldKind.TEXT for array in machine.arrays))
    lengths = [draw(st.integers(1, 3)) for _ in machine.lists]
    for names, array in zip(arrays, machine.arrays, strict=True):
        length = draw(st.integers(1, 3)) if array.list is None else lengths[array.list]
        observe[min(names)] = slice(size, size + length)
        size += length
    return observe | dict.fromkeys(ir.arrival_names(machine), 0), size + 1


def _acted(draw: st.DrawFn, machine: ir.Machine) -> tuple[dict[str, Place], int]:
    act: dict[str, Place] = {}
    for command in machine.reactions.commands:
        for field in command.fields:
            is_km = draw(st.integers(0, 3)) == 0
            place: Place = (len(act), "km/h") if is_km else len(act)
            act[".".join([command.topic, *map(str, field.path)])] = place
    return act, len(act) + 1


@st.composite
def _steps(draw: st.DrawFn, machine: ir.Machine, observed: int, acted: int) -> list[Step]:
    seen = st.one_of(st.sampled_from(NUMBERS), st.sampled_from(NUMBERS), raw(FieldKind.REAL))
    dtype = draw(st.sampled_from((np.float64, np.float32)))
    tasks = len(machine.reactions.tasks)
    report = st.tuples(st.integers(0, tasks - 1), st.booleans()) if tasks else st.none()
    steps = []
    for at_ns in sorted(draw(instants(16))):
        observation = np.array([draw(seen) for _ in range(observed)], np.float64)
        action = np.array([draw(st.sampled_from(WANTED)) for _ in range(acted)])
        with np.errstate(over="ignore"):
            narrow = action.astype(dtype)
        steps.append(Step(at_ns, observation, narrow, draw(st.one_of(st.none(), report))))
    return steps


def decided(decision: Decision) -> tuple[object, ...]:
    """All that a decision shows."""
    return (
        decision.action.dtype,
        decision.action.tobytes(),
        decision.active,
        decision.changed,
        decision.refused,
        decision.changed_by,
        decision.requests,
        decision.why(),
        # In words: a number that is unknown has a sign, which means nothing.
        [repr(each) for each in decision.margin.tolist()],
    )


def run_policy(
    guard: Guard, steps: list[Step], *, is_begun: bool = False
) -> list[tuple[object, ...]]:
    """Let an episode happen, or go on; gives all decisions."""
    found = []
    for number, step in enumerate(steps):
        if (number or is_begun) and step.report is not None:
            task, success = step.report
            guard.report(task, success=success)
        found.append(decided(guard.step(step.at_ns, step.observation, step.action)))
    return found
