"""Answers of the C++ of nodes to queries about skills, in a program that reads messages."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import rossmarie
from rossmarie.ir import SkillStep
from rossmarie.ir.skills import RunningSkill, SkillArgument, SkillContext
from rossmarie.targets.ros.messages import skill_query
from support.c_compiler import run

RUNTIME = Path(rossmarie.__file__).parent / "runtime" / "ros"
SOURCE = Path(__file__).parents[1] / "rossmarie" / "runtime" / "programs" / "skills.cpp"
STRICT = ("-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror",
          "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=undefined")  # fmt: skip


def of_node(
    folder: Path,
    queries: Sequence[SkillStep],
    contexts: Sequence[SkillContext],
    runtime: Path = RUNTIME,
    options: Sequence[str] = STRICT,
) -> list[list[float]]:
    """The answers of a node to all queries, for each of the messages."""
    asked = "".join(f"{skill_query(each)},\n" for each in queries)
    (folder / "queries.inc").write_text(asked, encoding="utf-8")
    program = folder / "skills"
    run(["g++", *options, f"-I{runtime}", f"-I{folder}", SOURCE, "-o", program])
    text = "\n".join(map(_line_of, contexts))
    lines = run([program], text.encode()).stdout.decode().splitlines()
    return [[float(word) for word in line.split()] for line in lines]


def bits(answers: Sequence[Sequence[float]]) -> str:
    """All answers, of which any NaN is like any other."""
    return repr(answers).replace("-nan", "nan")


# --- messages as text ---------------------------------------------------------------------------


def _line_of(context: SkillContext) -> str:
    words = [_quoted(context.digest), str(int(context.is_ahead_known))]
    for skills in (context.running, context.ahead):
        words += [str(len(skills)), *map(_skill, skills)]
    return " ".join(words)


def _skill(skill: RunningSkill) -> str:
    words = [_quoted(skill.skill), str(len(skill.arguments))]
    return " ".join([*words, *map(_argument, skill.arguments)])


def _argument(argument: SkillArgument) -> str:
    texts = [_quoted(argument.parameter), _quoted(argument.type)]
    pairs = [f"{_quoted(each.property)} {each.number!r}" for each in argument.properties]
    return " ".join([*texts, repr(argument.number), str(len(pairs)), *pairs])


def _quoted(text: str) -> str:
    """A text as `std::quoted` reads it."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
