"""Skills that can never work, because rules take away their resources whenever they run."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import z3

from crosscheck.asking import acts, queries, runs
from crosscheck.errors import NeverWorks, RulesNeverLetWork
from crosscheck.robot import Robot
from dslkit.diagnostics import Diagnostic, Remark, listed
from rossmarie.analysis.finding import witness_note
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.state import ArbitraryState
from rossmarie.analysis.trace import SymbolicTrace
from rossmarie.analysis.witness import View
from rossmarie.ir import Read
from rossmarie.ir.taking import Taking, takings
from rossmarie.skills import Skill


def find_unworkable(robot: Robot, inquiry: Inquiry) -> Iterator[Diagnostic]:
    """An error for each skill with a resource that is taken away whenever it runs."""
    for skill in robot.skills.skills.values():
        of_use: dict[str, list[Taking]] = {}
        for taking in takings(robot.machine, skill.uses):
            of_use.setdefault(taking.use.name, []).append(taking)
        for found in of_use.values():
            yield from _finding(robot, inquiry, skill, found)


def _finding(
    robot: Robot, inquiry: Inquiry, skill: Skill, found: Sequence[Taking]
) -> Iterator[Diagnostic]:
    rules = tuple(dict.fromkeys(taking.rule for taking in found))
    if not always_acts(inquiry, skill.name, rules):
        return
    alone = next((each for each in found if always_acts(inquiry, skill.name, (each.rule,))), None)
    machine = robot.machine
    if alone is None:
        first = found[0]
        names = [machine.rules[rule].name for rule in rules]
        labels = [RulesNeverLetWork.Active().at(machine.rules[rule].head) for rule in rules]
        several = RulesNeverLetWork(skill=skill.name, rules=listed(names), resource=first.use.name)
        yield several.at(robot.span_of(first.use.place), *labels)
        return
    rule, name = machine.rules[alone.rule], alone.use.name
    action = machine.reactions.actions[alone.task.action].name
    yield NeverWorks(skill=skill.name, rule=rule.name).at(
        rule.head,
        NeverWorks.Taken(action=action, resource=name).at(alone.task.span),
        NeverWorks.Needed(skill=skill.name, resource=name).at(robot.span_of(alone.use.place)),
        notes=_shown(inquiry.about(alone.rule), skill.name),
    )


def _shown(about: Inquiry, skill: str) -> list[Remark]:
    """A trace, confirmed by the interpreter, in which the skill runs while only this rule is
    active.
    """
    machine = about.machine
    condition = machine.rules[0].condition
    asked = queries(machine)
    running = [
        index
        for index, signal in enumerate(machine.signals)
        if isinstance(signal.node, Read)
        and (step := asked.get(signal.node.slot)) is not None
        and skill in step.skills
        and not step.is_ahead
    ]

    def in_trace(trace: SymbolicTrace) -> z3.BoolRef:
        first = trace.moments[0]
        return z3.And(runs(first, skill), first.proposition(condition).true)

    def in_view(seen: Sequence[View]) -> bool:
        return seen[-1].active[0] and all(seen[-1].signals[index] == 1.0 for index in running)

    witness = about.quick_witness((condition,), 1, in_trace, in_view)
    return [] if witness is None else [witness_note(machine, witness, (condition,))]


def always_acts(inquiry: Inquiry, skill: str, rules: Sequence[int]) -> bool:
    """Say whether it is proved that one of some rules is active whenever a skill runs."""
    about = inquiry.about(*rules)
    numbers = range(len(rules))

    def lets_work(state: ArbitraryState) -> z3.BoolRef:
        return z3.And(runs(state, skill), z3.Not(acts(state, *numbers)))

    return about.is_impossible(lets_work, settled=True)
