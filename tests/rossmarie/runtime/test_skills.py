"""A node has the same answers of the skills that run as Python has, whatever a message says."""

from __future__ import annotations

import json
import math
from pathlib import Path
from random import Random

import rossmarie
from rossmarie.ir.skills import RunningSkill, SkillArgument, SkillContext, answer
from rossmarie.targets.ros.messages import skill_question
from support.c_compiler import run
from support.parts import GXX, needs
from support.skill_contexts import random_context, random_question

HERE = Path(__file__).parent
RUNTIME = Path(rossmarie.__file__).parent / "runtime" / "ros"
OPTIONS = ("-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror",
           "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=undefined")  # fmt: skip
QUESTIONS = 40
CONTEXTS = 600


def line_of(context: SkillContext) -> str:
    words = [json.dumps(context.digest), str(len(context.running))]
    return " ".join([*words, *map(_skill, context.running)])


def _skill(skill: RunningSkill) -> str:
    words = [json.dumps(skill.skill), str(len(skill.arguments))]
    return " ".join([*words, *map(_argument, skill.arguments)])


def _argument(argument: SkillArgument) -> str:
    texts = [json.dumps(argument.parameter), json.dumps(argument.type)]
    pairs = [f"{json.dumps(each.property)} {each.number!r}" for each in argument.properties]
    return " ".join([*texts, repr(argument.number), str(len(pairs)), *pairs])


@needs(GXX)
def test_a_node_answers_as_python_does(tmp_path: Path) -> None:
    random = Random(60)
    questions = [random_question(random) for _ in range(QUESTIONS)]
    contexts = [random_context(random) for _ in range(CONTEXTS)]
    asked = "".join(f"{skill_question(each)},\n" for each in questions)
    (tmp_path / "questions.inc").write_text(asked, encoding="utf-8")
    program = tmp_path / "skills"
    source = HERE / "programs" / "skills.cpp"
    run(["g++", *OPTIONS, f"-I{RUNTIME}", f"-I{tmp_path}", source, "-o", program])
    text = "\n".join(map(line_of, contexts))
    lines = run([program], text.encode()).stdout.decode().splitlines()
    found = [[float(word) for word in line.split()] for line in lines]
    expected = [[answer(each, context) for each in questions] for context in contexts]
    assert repr(found).replace("-nan", "nan") == repr(expected)
    flat = [each for row in expected for each in row]
    assert {0.0, 1.0, 0.1} <= set(flat)
    assert any(map(math.isnan, flat))
