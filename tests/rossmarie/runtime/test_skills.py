"""A node has the same answers of the skills that run as Python has, whatever a message says."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from random import Random

import rossmarie
from rossmarie.ir import SkillStep
from rossmarie.ir.skills import RunningSkill, SkillArgument, SkillContext, answer
from rossmarie.targets.ros.messages import skill_question
from support.c_compiler import run
from support.parts import GXX, needs
from support.skill_contexts import random_context, random_question
from support.skill_worlds import any_context, asked_of, random_world

HERE = Path(__file__).parent
RUNTIME = Path(rossmarie.__file__).parent / "runtime" / "ros"
OPTIONS = ("-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror",
           "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=undefined")  # fmt: skip
QUESTIONS = 40
CONTEXTS = 600
WORLDS = 14
CONTEXTS_OF_EACH = 60


def line_of(context: SkillContext) -> str:
    words = [quoted(context.digest), str(len(context.running))]
    return " ".join([*words, *map(_skill, context.running)])


def _skill(skill: RunningSkill) -> str:
    words = [quoted(skill.skill), str(len(skill.arguments))]
    return " ".join([*words, *map(_argument, skill.arguments)])


def _argument(argument: SkillArgument) -> str:
    texts = [quoted(argument.parameter), quoted(argument.type)]
    pairs = [f"{quoted(each.property)} {each.number!r}" for each in argument.properties]
    return " ".join([*texts, repr(argument.number), str(len(pairs)), *pairs])


def quoted(text: str) -> str:
    """A text as `std::quoted` reads it."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def of_node(
    folder: Path, questions: Sequence[SkillStep], contexts: Sequence[SkillContext]
) -> list[list[float]]:
    """The answers of a node to all questions, for each of the messages."""
    asked = "".join(f"{skill_question(each)},\n" for each in questions)
    (folder / "questions.inc").write_text(asked, encoding="utf-8")
    program = folder / "skills"
    source = HERE / "programs" / "skills.cpp"
    run(["g++", *OPTIONS, f"-I{RUNTIME}", f"-I{folder}", source, "-o", program])
    lines = run([program], "\n".join(map(line_of, contexts)).encode()).stdout.decode().splitlines()
    return [[float(word) for word in line.split()] for line in lines]


def bits(answers: Sequence[Sequence[float]]) -> str:
    """All answers, of which any NaN is like any other."""
    return repr(answers).replace("-nan", "nan")


@needs(GXX)
def test_a_node_answers_as_python_does(tmp_path: Path) -> None:
    random = Random(60)
    questions = [random_question(random) for _ in range(QUESTIONS)]
    contexts = [random_context(random) for _ in range(CONTEXTS)]
    expected = [[answer(each, context) for each in questions] for context in contexts]
    assert bits(of_node(tmp_path, questions, contexts)) == bits(expected)
    flat = [each for row in expected for each in row]
    assert {0.0, 1.0, 0.1} <= set(flat)
    assert any(map(math.isnan, flat))


@needs(GXX)
def test_a_node_answers_as_the_semantics_say(tmp_path: Path) -> None:
    """Skills and classes over several levels, whose closed sets the node gets from the rules."""
    random = Random(62)
    worlds = [random_world(random) for _ in range(WORLDS)]
    asked = [asked_of(random, each, tmp_path) for each in worlds]
    contexts = [any_context(random, each, worlds) for each in worlds * CONTEXTS_OF_EACH]
    steps = [step for each in asked for step in each.steps()]
    expected = [
        [each.world.answer(one, context) for each in asked for one in each.questions]
        for context in contexts
    ]
    assert bits(of_node(tmp_path, steps, contexts)) == bits(expected)
    assert bits([[answer(each, one) for each in steps] for one in contexts]) == bits(expected)
    known = [each for row in expected for each in row if not math.isnan(each)]
    assert {0.0, 1.0, 0.25, 7.25} <= set(known)
