"""Skills that run in tests that nobody wrote: they answer the questions of rules as wanted."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping

import z3

from rossmarie import ir
from rossmarie.analysis.skills import message_facts, questions
from rossmarie.analysis.terms import YES, Number
from rossmarie.ir.script import Running
from rossmarie.ir.skills import RunningSkill, SkillArgument, SkillContext, answer

NOTHING = "doing nothing"
"""The words of tests in which no skill runs."""

_MOST_TRIED = 1000
"""Skills with arguments that are tried for one question."""


def is_question(machine: ir.Machine, slot: int) -> bool:
    """Say whether a slot asks which skills run."""
    return slot in questions(machine, machine.inputs[machine.slots[slot].input].channel)


def first_asking(machine: ir.Machine, slot: int) -> int:
    """The first slot of a channel that asks the same of its skills: both have one answer. A slot
    that asks nothing is its own.
    """
    asked = questions(machine, machine.inputs[machine.slots[slot].input].channel)
    return next((index for index, step in asked.items() if step == asked.get(slot)), slot)


def answer_facts(machine: ir.Machine, answers: Mapping[int, z3.ArithRef]) -> list[z3.BoolRef]:
    """Say what answers of skills, by slot, have to do with each other where all are known."""
    asked = {
        slot: Number(YES, term) for slot, term in answers.items() if is_question(machine, slot)
    }
    return message_facts(machine, asked, lambda _: YES)


def running_for(machine: ir.Machine, channel: int, answers: Mapping[int, float]) -> Running | None:
    """The skills that give these answers, by slot, 1 or 0; None if none do. Questions without a
    wanted answer may have any.
    """
    asked = questions(machine, channel)
    wanted = {asked[slot]: number for slot, number in answers.items() if slot in asked}
    denied = [step for step, number in wanted.items() if number == 0.0]
    found: dict[RunningSkill, None] = {}
    for step in sorted((step for step in wanted if step not in denied), key=_scope):
        if _answer(step, tuple(found)) == 1.0:
            continue
        skill = next((each for each in _candidates(step) if not _answers(denied, each)), None)
        if skill is None:
            return None
        found[skill] = None
    own = {slot: _answer(step, tuple(found)) for slot, step in asked.items()}
    if any(own[slot] != number for slot, number in answers.items() if slot in asked):
        return None  # two that ask the same have different answers, or one is not known
    text = ", ".join(map(_text, found)) or NOTHING
    return Running(machine.channels[channel].topic, tuple(found), text)


def _scope(step: ir.Doing) -> tuple[int, int]:
    """The least is that of the most special question, which answers others as well."""
    return -len(step.arguments), sum(len(classes) for _, classes in step.arguments)


def _answer(step: ir.Doing, skills: tuple[RunningSkill, ...]) -> float:
    return answer(step, SkillContext(step.export, skills))


def _answers(denied: list[ir.Doing], skill: RunningSkill) -> bool:
    return any(_answer(step, (skill,)) != 0.0 for step in denied)


def _candidates(step: ir.Doing) -> Iterator[RunningSkill]:
    """Skills that a question is about, the shortest names first: they are the least special."""
    parameters = [parameter for parameter, _ in step.arguments]
    choices = itertools.product(
        sorted(step.skills, key=len),
        *(sorted(classes, key=len) for _, classes in step.arguments),
    )
    for skill, *kinds in itertools.islice(choices, _MOST_TRIED):
        pairs = zip(parameters, kinds, strict=True)
        yield RunningSkill(skill, tuple(SkillArgument(name, type=kind) for name, kind in pairs))


def _text(skill: RunningSkill) -> str:
    """A skill as tests write it."""
    things = ", ".join(f"{each.parameter}: {each.type}" for each in skill.arguments)
    return f"doing {skill.skill}({things})" if things else f"doing {skill.skill}"
