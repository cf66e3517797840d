"""A node has the same answers of the skills that run as Python has, whatever a message says."""

from __future__ import annotations

import math
from pathlib import Path
from random import Random

from rossmarie.ir.skills import answer
from support.parts import GXX, needs
from support.skill_contexts import random_context, random_query
from support.skill_node import bits, of_node
from support.skill_tales import any_context
from support.skill_worlds import asked_of, random_world

QUERIES = 40
CONTEXTS = 600
WORLDS = 14
CONTEXTS_OF_EACH = 60


@needs(GXX)
def test_a_node_answers_as_python_does(tmp_path: Path) -> None:
    random = Random(60)
    queries = [random_query(random) for _ in range(QUERIES)]
    contexts = [random_context(random) for _ in range(CONTEXTS)]
    expected = [[answer(each, context) for each in queries] for context in contexts]
    assert bits(of_node(tmp_path, queries, contexts)) == bits(expected)
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
        [each.world.answer(one, context) for each in asked for one in each.queries]
        for context in contexts
    ]
    assert bits(of_node(tmp_path, steps, contexts)) == bits(expected)
    assert bits([[answer(each, one) for each in steps] for one in contexts]) == bits(expected)
    known = [each for row in expected for each in row if not math.isnan(each)]
    assert {0.0, 1.0, 0.25, 7.25} <= set(known)
