"""Queries about skills are answered as S58 says, for any message; and a machine holds those
answers for possible that some skills give.
"""

from __future__ import annotations

from pathlib import Path
from random import Random
from typing import cast

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.engines import NamedValues
from rossmarie.ir.calls import covering
from rossmarie.ir.skills import SkillContext, SkillMessage, answer
from support.depth import examples
from support.recordings import ROS1, ROS2
from support.skill_contexts import message
from support.skill_tales import any_context, honest_context
from support.skill_worlds import Asked, asked_of, random_world

CONTEXTS = 12
seeds = st.integers(0, 2**64)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("skills")


def asking(seed: int, folder: Path) -> tuple[Random, Asked]:
    random = Random(seed)
    return random, asked_of(random, random_world(random), folder)


def wanted(asked: Asked, context: SkillContext) -> list[float]:
    return [asked.world.answer(each, context) for each in asked.queries]


@settings(max_examples=examples(2))
@given(seeds)
def test_answers_are_those_of_the_semantics(folder: Path, seed: int) -> None:
    random, asked = asking(seed, folder)
    for _ in range(CONTEXTS):
        context = any_context(random, asked.world, [random_world(random)])
        found = [answer(each, context) for each in asked.steps()]
        assert repr(found) == repr(wanted(asked, context))


@settings(max_examples=examples(0.5))
@given(seeds)
def test_messages_of_libraries_answer_the_same(folder: Path, seed: int) -> None:
    random, asked = asking(seed, folder)
    named = NamedValues(asked.machine)
    for ros in (ROS1, ROS2):
        context = any_context(random, asked.world)
        reported = cast("SkillMessage", message(ros, 0, context)[1])
        assert repr([answer(each, reported) for each in asked.steps()]) == repr(
            wanted(asked, context)
        )
        if named.queries.is_context("skill_context", reported):
            (values,) = named.messages({"skill_context": reported}).values()
            assert repr(list(values.slots.values())) == repr(wanted(asked, context))


@settings(max_examples=examples(2))
@given(seeds)
def test_what_skills_answer_is_what_some_calls_answer(folder: Path, seed: int) -> None:
    random, asked = asking(seed, folder)
    for _ in range(CONTEXTS):
        context = honest_context(random, asked.world)
        answers = dict(zip(asked.steps(), wanted(asked, context), strict=True))
        flags = {step: yes == 1 for step, yes in answers.items() if isinstance(step, ir.Doing)}
        chosen = covering(asked.machine.calls, flags)
        assert chosen is not None, (flags, context)
        reported = SkillContext.of(asked.world.digest, [call.running for call in chosen])
        assert {step: answer(step, reported) == 1.0 for step in flags} == flags
