"""Queries to skills: no message answers them so that they contradict each other."""

from __future__ import annotations

import math
import shutil
from pathlib import Path
from random import Random

import z3
from hypothesis import given
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.analysis.quantities import quantity_facts
from rossmarie.analysis.terms import NumberTerm, constant
from rossmarie.driver.analyze import analyze_file
from rossmarie.ir import Doing
from rossmarie.ir.skills import answer
from support.drafts import Draft
from support.skill_contexts import random_context, random_query

RULES = Path(__file__).parents[2] / "fixtures" / "skillful"


@given(st.integers(0, 2**64))
def test_the_facts_hold_in_every_message(seed: int) -> None:
    random = Random(seed)
    queries = [random_query(random) for _ in range(8)]
    context = random_context(random)
    draft = Draft()
    draft.input(draft.channel())
    for each in (*queries, queries[0]):
        kind = ir.FieldKind.FLAG if isinstance(each, Doing) else ir.FieldKind.REAL
        draft.slots.append(ir.Slot(0, (each,), kind, 1.0, 0.0, ""))
    answers = [answer(each, context) for each in (*queries, queries[0])]
    numbers = {
        slot: NumberTerm(z3.BoolVal(not math.isnan(found)), constant(_finite(found)))
        for slot, found in enumerate(answers)
    }
    facts = list(quantity_facts(draft.machine(), numbers))
    assert z3.is_true(z3.simplify(z3.And(facts)))


def _finite(number: float) -> float:
    return number if math.isfinite(number) else 0.0


def codes(folder: Path, rules: str) -> list[tuple[str, str]]:
    """The findings of a check of these rules after the rules of the fixture: codes and rules."""
    path = Path(shutil.copytree(RULES, folder / "rules")) / "skillful.ross"
    path.write_text(path.read_text(encoding="utf-8") + rules, encoding="utf-8")
    found = analyze_file(path).findings
    return [(each.diagnostic.code, each.diagnostic.primary.span.text) for each in found]


def test_what_no_skill_answers_is_never_true(tmp_path: Path) -> None:
    never = """
rule one: if doing Push(Object: Glass) and not doing Push(Object: Fragile) then { creep; };
rule two: if doing Push(Object: Fragile) and not doing Push then { creep; };
rule three: if weight > 1 kg and not doing Push then { creep; };
"""
    found = codes(tmp_path, never)
    assert found == [("ROSS703", "one"), ("ROSS703", "two"), ("ROSS703", "three")]


def test_what_a_skill_may_answer_is_not_found(tmp_path: Path) -> None:
    sometimes = """
rule one: if doing Push(Object: Fragile) and not doing Push(Object: Glass) then { creep; };
rule two: if weight > 1 kg and doing Push and not doing Push(Object: Fragile) then { creep; };
"""
    assert codes(tmp_path, sometimes) == []
