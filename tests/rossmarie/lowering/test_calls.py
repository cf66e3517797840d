"""The calls that a machine knows, against all that skills can do."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.ir.calls import covering, query_at
from rossmarie.ir.skills import RunningSkill, SkillArgument, SkillContext, answer
from rossmarie.lowering import calls
from rossmarie.skills import Closure, parse_skills, read_text
from support.compiled import machine_of
from support.depth import examples
from support.rule_skills import DIGEST, FILE, HEAD, content

SKILLS = parse_skills(read_text(FILE))
BELOW = Closure({name: each.parents for name, each in SKILLS.classes.items()})

QUERIES = (
    "doing Move",
    "doing Drive(Target: Shelf)",
    "doing Push",
    "doing Push(Object: Fragile)",
    "doing Push(Object: skiros.Box)",
    "doing Push(Object: Glass)",
    "doing Insert(Object: Product)",
    "doing Insert(Object: Fragile)",
    "ahead Move",
    "ahead Drive(Target: Shelf)",
    "ahead Push(Object: Fragile)",
    "ahead Push(Object: Glass)",
)


@st.composite
def contexts(draw: st.DrawFn) -> SkillContext:
    """Any skills, with individuals of any classes that their parameters demand."""
    found = []
    for name in draw(st.lists(st.sampled_from(sorted(SKILLS.skills)), max_size=3)):
        individuals = [each for each in SKILLS.skills[name].parameters.values() if "." in each.type]
        classes = {each.name: draw(st.sampled_from(BELOW.below(each.type))) for each in individuals}
        is_ahead = draw(st.booleans())
        if is_ahead:  # some arguments are not known yet
            classes = {which: kind for which, kind in classes.items() if draw(st.booleans())}
        arguments = tuple(SkillArgument(which, type=kind) for which, kind in classes.items())
        found.append(RunningSkill(name, arguments, is_ahead))
    return SkillContext.of(DIGEST, found)


def machine_asking(queries: list[str]) -> ir.Machine:
    return machine_of(HEAD + f"rule it: if {' or '.join(queries)} then {{ stop; }};")


def steps_of(machine: ir.Machine) -> list[ir.Doing]:
    found = (query_at(slot.path) for slot in machine.slots)
    return [step for step in found if step is not None]


@settings(max_examples=examples(2))
@given(st.lists(st.sampled_from(QUERIES), min_size=1, unique=True), contexts())
def test_what_skills_answer_is_what_some_calls_answer(
    queries: list[str], context: SkillContext
) -> None:
    machine = machine_asking(queries)
    wanted = {step: answer(step, context) == 1.0 for step in steps_of(machine)}
    chosen = covering(machine.calls, wanted)
    assert chosen is not None
    reported = SkillContext.of(DIGEST, [call.running for call in chosen])
    assert {step: answer(step, reported) == 1.0 for step in wanted} == wanted


@settings(max_examples=examples(1))
@given(st.lists(st.sampled_from(QUERIES), min_size=1, unique=True))
def test_no_two_calls_answer_the_same(queries: list[str]) -> None:
    machine = machine_asking(queries)
    answers = [tuple(call.answers(step) for step in steps_of(machine)) for call in machine.calls]
    assert len(set(answers)) == len(answers)
    assert all(map(any, answers))


def test_answers_that_no_skills_give_are_covered_by_none() -> None:
    machine = machine_asking(["doing Push", "doing Push(Object: Fragile)"])
    push, fragile = steps_of(machine)
    assert covering(machine.calls, {push: False, fragile: True}) is None
    assert covering(machine.calls, {push: False, fragile: False}) == ()
    (call,) = covering(machine.calls, {push: True, fragile: False}) or ()
    assert call.text == "doing Push"
    (call,) = covering(machine.calls, {fragile: True}) or ()
    assert call.text == "doing Push(Object: skiros.Fragile)"


def test_an_individual_may_be_of_several_classes(tmp_path: Path) -> None:
    """One that is a product and a box, and yet none of the chests, which are both."""
    found = content()
    chest = {**found["classes"][0], "name": "toys.Chest"}
    found["classes"].append({**chest, "parents": ["skiros.Product", "toys.Box"]})
    (tmp_path / "skills.json").write_text(json.dumps(found), encoding="utf-8")
    queries = ["doing Push(Object: toys.Box)", "doing Push(Object: Chest)"]
    head = HEAD.replace(str(FILE), str(tmp_path / "skills.json"))
    machine = machine_of(f"{head} rule it: if {' or '.join(queries)} then {{ stop; }};")
    box, chest_step = steps_of(machine)
    (call,) = covering(machine.calls, {box: True, chest_step: False}) or ()
    assert call.types == (("Object", "skiros.Product"), ("Object", "toys.Box"))
    assert call.text is None


def test_a_parameter_may_have_no_value() -> None:
    machine = machine_asking(["doing Push", "doing Push(Object: Product)"])
    push, product = steps_of(machine)
    (call,) = covering(machine.calls, {push: True, product: False}) or ()
    assert (call.types, call.text) == ((("Object", ""),), None)


def test_of_too_many_calls_none_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(calls, "MOST_CALLS", 1)
    assert machine_asking(["doing Push", "doing Insert"]).calls == ()
