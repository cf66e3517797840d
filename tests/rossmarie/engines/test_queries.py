"""Answers of skills by names: all of a message, or one query in the words of the rules."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rossmarie.driver import compile_file
from rossmarie.engines import NamedValues
from rossmarie.guard import Guard, MappingError
from rossmarie.ir.skills import RunningSkill, SkillArgument, SkillContext, SkillProperty

FOLDER = Path(__file__).parents[2] / "fixtures" / "skillful"
DIGEST = f"c0ffee{'0' * 58}"
QUERY = "doing Push(Object: Fragile)"
GLASS = SkillArgument("Object", type="skiros.Glass", properties=(
    SkillProperty("skiros.Weight", 7.0),
))  # fmt: skip
CONTEXT = SkillContext(DIGEST, (RunningSkill("Push", (GLASS,)),))
MACHINE = compile_file(FOLDER / "skillful.ross").machine
SKILLS = MACHINE.inputs[1].channel


def test_a_message_answers_all_queries_on_its_topic() -> None:
    values = NamedValues(MACHINE)
    asked = [i for i, s in enumerate(MACHINE.slots) if MACHINE.inputs[s.input].channel == SKILLS]
    found = values.messages({"skill_context": CONTEXT})
    assert sorted(found) == [SKILLS]
    assert [found[SKILLS].slots[index] for index in asked] == [1.0, 1.0, 1.0, 7.0, 0.0]
    other = values.messages({"skill_context": replace(CONTEXT, digest="")})
    assert np.isnan([other[SKILLS].slots[index] for index in asked]).all()


def test_one_query_is_answered_for_all_inputs_that_ask_it() -> None:
    found = NamedValues(MACHINE).messages({QUERY: True, "weight": 2.0})
    named = {MACHINE.inputs[MACHINE.slots[i].input].name: x for i, x in found[SKILLS].slots.items()}
    assert named == {"skill_context": 1.0, "skill_context_kept": 1.0, "weight": 2.0}


def test_a_name_that_is_no_query_is_reported() -> None:
    with pytest.raises(KeyError, match="did you mean `doing Push\\(Object: Fragile\\)`"):
        NamedValues(MACHINE).messages({"doing Push(Object: Fragil)": True})


@pytest.mark.parametrize("observe", [{"force.x": 0}, {"force.x": 0, QUERY: 1}])
def test_what_is_asked_has_to_be_observed(observe: dict[str, int | slice]) -> None:
    with pytest.raises(MappingError) as caught:
        Guard(MACHINE, observe, {"linear.x": 0})
    assert str(caught.value).count(QUERY) == (QUERY not in observe)


def test_a_policy_is_guarded_by_what_it_does(tmp_path: Path) -> None:
    rules = Path(shutil.copytree(FOLDER, tmp_path / "rules")) / "skillful.ross"
    text = rules.read_text(encoding="utf-8")
    rules.write_text(
        "\n".join(
            line for line in text.splitlines() if "weight" not in line and "ahead" not in line
        )
    )
    observe = {"force.x": 0, "force.y": 1, "force.z": 2, QUERY: 3}
    guard = Guard(compile_file(rules).machine, observe, {"linear.x": 0})
    decision = guard.step(0, np.array([20.0, 0.0, 0.0, 0.0]), np.array([1.0]))
    assert (decision.active, decision.action.tolist()) == (("contact",), [0.0])
    decision = guard.step(1, np.array([20.0, 0.0, 0.0, 1.0]), np.array([1.0]))
    assert (decision.active, decision.action.tolist()) == (("contact_doing_Push",), [0.2])
