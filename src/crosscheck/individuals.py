"""Rules and skills compared with the individuals of a scene: those that a rule queries, those that
a skill needs, and the numbers that a rule reads.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import z3

from crosscheck.asking import queries, tells
from crosscheck.errors import NeverInScene, NoNumberInScene, NothingToTake
from crosscheck.robot import Robot
from dslkit.diagnostics import Diagnostic, listed
from dslkit.source import Span
from rossmarie import ir
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.state import ArbitraryState
from rossmarie.skills import Skill, SkillParameter

if TYPE_CHECKING:  # only for users with a scene
    from crosscheck.scene import SceneModel


def find_nothing_to_take(robot: Robot, scene: SceneModel) -> Iterator[Diagnostic]:
    """A warning for each class that skills need and that has no individual in the scene."""
    needed: dict[str, list[tuple[Skill, SkillParameter]]] = {}
    for skill in robot.skills.skills.values():
        for parameter in _individuals_of(robot, skill):
            if parameter.is_needed and not scene.individuals(parameter.type):
                needed.setdefault(parameter.type, []).append((skill, parameter))
    for owl_class, found in needed.items():
        names = listed(list(dict.fromkeys(skill.name for skill, _ in found)))
        (_, first), *more = found
        places = dict.fromkeys(robot.span_of(each.place) for _, each in more)
        labels = [NothingToTake.Needed().at(place) for place in places]
        yield NothingToTake(owl_class=owl_class, skills=names).at(
            robot.span_of(first.place), *labels
        )


def find_never_in_scene(robot: Robot, scene: SceneModel) -> Iterator[Diagnostic]:
    """A warning for each query that no individual of the scene can make true."""
    asked = dict(_asked(robot.machine))
    for span, step in asked.items():
        for parameter, classes in step.arguments:
            possible = _possible(robot, scene, step, parameter)
            if possible and not any(scene.is_a(individual, classes) for individual in possible):
                known = listed(scene.classes(possible))
                help = NeverInScene.Others(parameter=parameter, known=known)
                never = NeverInScene(query=str(step), parameter=parameter)
                yield never.at(span, help=help)
                break


def _possible(robot: Robot, scene: SceneModel, step: ir.Doing, parameter: str) -> tuple[str, ...]:
    """The individuals that a parameter of the queried skills can stand for; none if a skill may set
    the parameter while it runs.
    """
    skills = (robot.skills.skills.get(name) for name in step.skills)
    found = [skill.parameters.get(parameter) for skill in skills if skill is not None]
    if any(each is None or not each.is_needed for each in found):
        return ()
    return scene.individuals(*dict.fromkeys(each.type for each in found if each is not None))


def _individuals_of(robot: Robot, skill: Skill) -> Iterator[SkillParameter]:
    """The parameters of a skill that stand for individuals."""
    for each in skill.parameters.values():
        if each.type in robot.skills.classes:
            yield each


def _asked(machine: ir.Machine) -> Iterator[tuple[Span, ir.Doing]]:
    """The queries about skills, each with its place in the rules."""
    asked = queries(machine)
    for proposition in machine.propositions:
        if isinstance(proposition.node, ir.Flag):
            signal = machine.signals[proposition.node.signal].node
            if isinstance(signal, ir.Read) and signal.slot in asked:
                yield proposition.span, asked[signal.slot]


# --- numbers -------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Reading:
    """A rule that reads a number of an individual: its place in the machine, and the slot."""

    rule: int
    slot: int
    step: ir.Quantity


def find_no_numbers(robot: Robot, scene: SceneModel, inquiry: Inquiry) -> Iterator[Diagnostic]:
    """A warning for each individual without a number that a rule needs while a skill uses the
    individual.
    """
    stale: dict[tuple[str, str], list[tuple[_Reading, Skill]]] = {}
    for reading in _readings(robot.machine, inquiry):
        answers: dict[tuple[bool | None, ...], bool] = {}
        for skill, individual in _taken(robot, scene, reading):
            known = _answers(inquiry.about(reading.rule).machine, scene, reading, skill, individual)
            key = tuple(known.values())
            if key not in answers:
                answers[key] = _is_stale(inquiry, reading, known)
            if answers[key]:
                stale.setdefault((individual, str(reading.step.property)), []).append(
                    (reading, skill)
                )
    for (individual, name), found in stale.items():
        yield _without_number(robot, scene, individual, name, found)


def _readings(machine: ir.Machine, inquiry: Inquiry) -> Iterator[_Reading]:
    """The numbers of individuals that rules read. Rules that only report an exemption are left out:
    they do nothing without the number.
    """
    for number, rule in enumerate(machine.rules):
        if rule.exempts is not None:
            continue
        for signal in inquiry.about(number).machine.signals:
            if isinstance(signal.node, ir.Read):
                path = machine.slots[signal.node.slot].path
                step = path[0] if path else None
                if isinstance(step, ir.Quantity) and step.property is not None:
                    yield _Reading(number, signal.node.slot, step)


def _taken(robot: Robot, scene: SceneModel, reading: _Reading) -> Iterator[tuple[Skill, str]]:
    """The skills whose number a rule reads, each with the individuals that it could use and that
    have no such number.
    """
    for name in reading.step.skills:
        skill = robot.skills.skills.get(name)
        parameter = skill.parameters.get(reading.step.parameter) if skill is not None else None
        if skill is not None and parameter is not None:
            for individual in scene.individuals(parameter.type):
                number = scene.numbers(individual).get(str(reading.step.property))
                if number is None or number != number:  # NaN
                    yield skill, individual


def _answers(
    machine: ir.Machine, scene: SceneModel, reading: _Reading, skill: Skill, individual: str
) -> Mapping[int, bool | None]:
    """The answers to all queries while only this skill runs, with this individual. None for queries
    that depend on other individuals.
    """
    found: dict[int, bool | None] = {}
    for slot, step in queries(machine).items():
        arguments = dict(step.arguments)
        wanted = arguments.pop(reading.step.parameter, None)
        fits = skill.name in step.skills and (wanted is None or scene.is_a(individual, wanted))
        found[slot] = None if step.is_ahead or (fits and arguments) else fits
    return found


def _is_stale(inquiry: Inquiry, reading: _Reading, answers: Mapping[int, bool | None]) -> bool:
    """Say whether the missing number alone can make a rule stale."""
    about = inquiry.about(reading.rule)
    machine = about.machine
    read = {each.node.slot for each in machine.signals if isinstance(each.node, ir.Read)}

    def is_stale(state: ArbitraryState) -> z3.BoolRef:
        others = [state.slot(slot).known for slot in sorted(read - {reading.slot})]
        condition = state.proposition(machine.rules[0].condition)
        return z3.And(
            *tells(state, answers), *others, z3.Not(state.slot(reading.slot).known), condition.stale
        )

    return about.is_possible(is_stale, settled=True)


def _without_number(
    robot: Robot,
    scene: SceneModel,
    individual: str,
    name: str,
    found: list[tuple[_Reading, Skill]],
) -> Diagnostic:
    rules = dict.fromkeys(reading.rule for reading, _ in found)
    names = [robot.machine.rules[rule].name for rule in rules]
    reading, skill = found[0]
    without = NoNumberInScene(
        individual=scene.spelled(individual),
        problem="has no single" if name in scene.numbers(individual) else "has no",
        property=name,
        rules=listed(names),
        hold="holds" if len(names) == 1 else "hold",
        skill=skill.name,
    )
    label = NoNumberInScene.Read(query=str(reading.step))
    heads = [robot.machine.rules[rule].head for rule in rules]
    return without.at(scene.place(individual), *(label.at(head) for head in heads))
