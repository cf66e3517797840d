"""Rules whose effect on a command keeps the rule active, or clears it.

An input may read the commands that have passed the filter. While a rule bounds such a command, or
publishes it itself, the input receives only numbers within known limits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import z3

from dslkit.diagnostics import Diagnostic, Label
from rossmarie.analysis.errors import (
    Escalated,
    LimitEndsCondition,
    LimitHoldsCondition,
    LimitHoldsRelease,
    WhileActive,
)
from rossmarie.analysis.finding import Finding
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.state import ArbitraryState
from rossmarie.analysis.terms import YES, within
from rossmarie.ir import Array, Machine, Slot
from rossmarie.ir.carried import si_ends
from rossmarie.ir.reactions import (
    Call,
    CancelGoal,
    Diagnose,
    Hook,
    Limit,
    Log,
    Publish,
    Reset,
    Retrace,
    Scale,
    SendGoal,
    SetParameter,
    SwitchControllers,
)
from rossmarie.naming.node import unfiltered


@dataclass(frozen=True)
class Kept:
    """The ends between which a field of a command stays while a task is in force, in the unit of
    the message.
    """

    task: int
    command: int
    field: int
    low: float
    high: float


def find_self_holding(inquiry: Inquiry) -> Iterator[Finding]:
    """A warning for each rule that is not cleared while its own tasks are in force, or is cleared
    by them.
    """
    machine = inquiry.machine
    for rule, plan in enumerate(machine.reactions.plans):
        kept = [each for task in plan.tasks for each in _kept(machine, task)]
        read = [each for each in kept if _is_read(inquiry, rule, each)]
        if not read or inquiry.is_impossible(partial(is_ended, rule=rule)):
            continue  # another query reports rules that are never cleared at all
        for together in _groups(plan.stages, read):
            found = _judged(inquiry, rule, together)
            if found is not None:
                yield Finding(found)
                break


def _groups(stages: Sequence[Sequence[int]], read: Sequence[Kept]) -> Iterator[list[Kept]]:
    """The effects that can be in force together, the fewest first: one task, all tasks of the plan
    without failures, and these tasks with one escalation.
    """
    planned = {task for stage in stages for task in stage}
    tasks = list(dict.fromkeys(each.task for each in read))
    groups = [{task} for task in tasks]
    groups.append(planned)
    groups += [planned | {task} for task in tasks if task not in planned]
    for group in groups:
        yield [each for each in read if each.task in group]


# --- what is kept ----------------------------------------------------------------------------


def _kept(machine: Machine, task: int) -> list[Kept]:
    effect = machine.reactions.tasks[task].effect
    match effect:
        case Limit(topic=topic, bounds=bounds):
            return [Kept(task, topic, each.field, each.low, each.high) for each in bounds]
        case Scale(topic=topic, factor=factor):
            fields = machine.reactions.commands[topic].fields if factor == 0.0 else ()
            return [Kept(task, topic, field, 0.0, 0.0) for field in range(len(fields))]
        case Publish():
            return list(_published(machine, task, effect))
        case (
            Call()
            | Retrace()
            | SetParameter()
            | SwitchControllers()
            | SendGoal()
            | CancelGoal()
            | Log()
            | Diagnose()
            | Hook()
            | Reset()
        ):
            return []


def _published(machine: Machine, task: int, effect: Publish) -> Iterator[Kept]:
    """The fields of a command that a rule publishes at a rate, in place of other commands. A bound
    on the same field contains 0, so it moves the field closer to 0.
    """
    command = effect.command
    if command is None or effect.period_ns is None:
        return
    given = {each.path: each.value for each in effect.assignments}
    for field, declared in enumerate(machine.reactions.commands[command].fields):
        value = given.get(declared.path, 0.0)
        numbers = [float(each) for each in (value if isinstance(value, tuple) else (value,))]
        yield Kept(task, command, field, min(0.0, *numbers), max(0.0, *numbers))


# --- what is read ----------------------------------------------------------------------------


def _is_read(inquiry: Inquiry, rule: int, kept: Kept) -> bool:
    """Say whether the clearing of a rule depends on a field."""
    machine = inquiry.machine
    supports = [inquiry.asked.supports.propositions[root] for root in machine.rules[rule].roots]
    return any(
        slot in support.slots | support.beside
        for support in supports
        for slot in _slots(machine, kept)
    ) or any(array in support.arrays for support in supports for array in _arrays(machine, kept))


def _slots(machine: Machine, kept: Kept) -> Iterator[int]:
    """The slots that carry a field, or an element of it."""
    field = machine.reactions.commands[kept.command].fields[kept.field]
    for index, slot in enumerate(machine.slots):
        path = slot.path[:-1] if field.is_array else slot.path
        if path == field.path and _is_on(machine, slot, kept):
            yield index


def _arrays(machine: Machine, kept: Kept) -> Iterator[int]:
    """The arrays that carry a field."""
    field = machine.reactions.commands[kept.command].fields[kept.field]
    for index, array in enumerate(machine.arrays):
        if field.is_array and array.path == field.path and _is_on(machine, array, kept):
            yield index


def _is_on(machine: Machine, source: Slot | Array, kept: Kept) -> bool:
    topic = machine.channels[machine.inputs[source.input].channel].topic
    return topic == machine.reactions.commands[kept.command].topic


# --- predicates ----------------------------------------------------------------------------------


def is_ended(state: ArbitraryState, rule: int) -> z3.BoolRef:
    """Say whether an active rule is cleared by the evaluation, or by a reset immediately after
    it.
    """
    return z3.And(
        state.proposition(state.machine.rules[rule].condition).false, _is_free(state, rule)
    )


def _is_free(state: ArbitraryState, rule: int) -> z3.BoolRef:
    """Say whether only its condition keeps a rule active."""
    release = state.machine.rules[rule].release
    return YES if release is None else state.proposition(release).true


def is_within(state: ArbitraryState, kept: Sequence[Kept]) -> z3.BoolRef:
    """Say whether all values read from some fields lie within their limits."""
    machine = state.machine
    slots = [
        _lies(machine.slots[slot], state.slot(slot).value, each)
        for each in kept
        for slot in _slots(machine, each)
    ]
    cells = [
        _lies(machine.arrays[array], cell.number.value, each)
        for each in kept
        for array in _arrays(machine, each)
        for cell in state.cells(array)
    ]
    return z3.And(slots + cells)


def _lies(source: Slot | Array, value: z3.ArithRef, kept: Kept) -> z3.BoolRef:
    return z3.And(within(value, si_ends(source, (kept.low, kept.high))))


# --- findings --------------------------------------------------------------------------------


def _judged(inquiry: Inquiry, rule: int, kept: Sequence[Kept]) -> Diagnostic | None:
    """A finding about a rule while some fields are kept within limits: its condition cannot be
    false, it cannot be released, or its condition cannot be true. None if the fields have no such
    effect.
    """

    def never(predicate: Callable[[ArbitraryState], z3.BoolRef]) -> bool:
        return inquiry.is_impossible(
            lambda state: z3.And(predicate(state), is_within(state, kept)), settled=True
        )

    machine = inquiry.machine
    declared = machine.rules[rule]
    places = _places(machine, rule, kept)
    does = _does(machine, kept)
    if never(lambda state: state.proposition(declared.condition).false):
        asked = _asked(machine, kept)
        holds = LimitHoldsCondition(rule=declared.name, does=does, asked=asked)
        return holds.at(declared.head, *places)
    release = declared.release
    if release is None:
        return None
    if not never(partial(is_ended, rule=rule)):
        if not never(lambda state: state.proposition(declared.condition).true):
            return None
        ends = LimitEndsCondition(rule=declared.name, does=does, asked=_asked(machine, kept))
        return ends.at(declared.head, *places)
    is_never = never(lambda state: state.proposition(release).true)
    stuck = LimitHoldsRelease(
        rule=declared.name,
        does=does,
        release=machine.propositions[release].text,
        when="never true" if is_never else "not true while the condition is false",
    )
    place = stuck.Release().at(machine.propositions[release].span)
    return stuck.at(declared.head, place, *places)


def _places(machine: Machine, rule: int, kept: Sequence[Kept]) -> Iterator[Label]:
    planned = {task for stage in machine.reactions.plans[rule].stages for task in stage}
    for task in dict.fromkeys(each.task for each in kept):
        when = WhileActive() if task in planned else Escalated()
        yield when.at(machine.reactions.tasks[task].span)


def _asked(machine: Machine, kept: Sequence[Kept]) -> str:
    """The topics on which commands enter the filter: `/unfil_cmd_vel`."""
    topics = dict.fromkeys(machine.reactions.commands[each.command].topic for each in kept)
    return ", ".join(f"`{unfiltered(topic)}`" for topic in topics)


def _does(machine: Machine, kept: Sequence[Kept]) -> str:
    """The effect of a rule on its fields, in words: `limits linear.x and linear.y on /cmd_vel`."""
    fields: dict[tuple[str, int], dict[str, None]] = {}
    for each in kept:
        effect = machine.reactions.tasks[each.task].effect
        verb = "publishes" if isinstance(effect, Publish) else "limits"
        path = machine.reactions.commands[each.command].fields[each.field].path
        fields.setdefault((verb, each.command), {})[".".join(map(str, path))] = None
    return " and ".join(
        f"{verb} {_listed(list(names))} on {machine.reactions.commands[command].topic}"
        for (verb, command), names in fields.items()
    )


def _listed(names: Sequence[str]) -> str:
    return " and ".join([*([", ".join(names[:-1])] if names[1:] else []), names[-1]])
