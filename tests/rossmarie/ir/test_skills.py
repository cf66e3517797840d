"""Answers of the skills that run to queries, and messages that answer nothing."""

from __future__ import annotations

import math
from dataclasses import replace
from random import Random
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.ir import Doing, Quantity, SkillStep
from rossmarie.ir.path import path_text, path_words
from rossmarie.ir.skills import RunningSkill, SkillArgument, SkillContext, SkillProperty, answer
from support.drafts import Draft
from support.skill_contexts import DIGEST, crowd, random_context, random_query

FRAGILE = Doing(DIGEST, ("Push", "PushGently"), (("Object", ("skiros.Fragile", "skiros.Glass")),))
PUSH = Doing(DIGEST, ("Push", "PushGently"))
WEIGHT = Quantity(DIGEST, ("Push",), "Object", "skiros.Weight")
DEPTH = Quantity(DIGEST, ("Push",), "Depth")

GLASS = SkillArgument("Object", "the glass", "skiros.Glass", properties=(
    SkillProperty("skiros.Weight", 0.3), SkillProperty("skiros.Length", 0.1),
))  # fmt: skip
PUSHES = RunningSkill("Push", (GLASS, SkillArgument("Depth", number=0.25)))


def context(*running: RunningSkill) -> SkillContext:
    return SkillContext(DIGEST, running)


def test_a_running_skill_is_found_with_its_arguments() -> None:
    assert answer(PUSH, context(RunningSkill("Drive"), PUSHES)) == 1.0
    assert answer(FRAGILE, context(PUSHES)) == 1.0
    assert answer(WEIGHT, context(PUSHES)) == 0.3
    assert answer(DEPTH, context(PUSHES)) == 0.25


def test_what_does_not_run_is_not_done() -> None:
    box = replace(GLASS, type="skiros.Box")
    assert answer(PUSH, context()) == 0.0
    assert answer(PUSH, context(RunningSkill("Drive", PUSHES.arguments))) == 0.0
    assert answer(FRAGILE, context(RunningSkill("Push", (box,)))) == 0.0
    assert answer(FRAGILE, context(RunningSkill("Push"))) == 0.0


def test_all_arguments_are_those_of_one_skill() -> None:
    asked = replace(FRAGILE, arguments=(*FRAGILE.arguments, ("Target", ("sumo.Shelf",))))
    target = SkillArgument("Target", "the shelf", "sumo.Shelf")
    apart = (RunningSkill("Push", (GLASS,)), RunningSkill("Push", (target,)))
    assert answer(asked, context(*apart)) == 0.0
    assert answer(asked, context(RunningSkill("Push", (GLASS, target)))) == 1.0


def test_a_quantity_is_that_of_the_only_skill() -> None:
    assert math.isnan(answer(WEIGHT, context()))
    assert math.isnan(answer(WEIGHT, context(PUSHES, PUSHES)))
    assert math.isnan(
        answer(WEIGHT, context(RunningSkill("Push", (replace(GLASS, properties=()),))))
    )
    assert math.isnan(answer(DEPTH, context(RunningSkill("Push", (GLASS,)))))
    assert answer(DEPTH, context(RunningSkill("Drive"), PUSHES)) == 0.25


def test_of_another_export_nothing_is_known() -> None:
    other = replace(context(PUSHES), digest="c0ffe")
    assert all(math.isnan(answer(each, other)) for each in (PUSH, FRAGILE, WEIGHT, DEPTH))


def test_an_individual_of_several_classes_is_of_each() -> None:
    box = replace(GLASS, type="skiros.Box")
    for individuals in ((GLASS, box), (box, GLASS)):
        both = context(RunningSkill("Push", individuals))
        assert (answer(FRAGILE, both), answer(WEIGHT, both)) == (1.0, 0.3)
    assert answer(FRAGILE, context(RunningSkill("Push", (box, box)))) == 0.0


@pytest.mark.parametrize("other", [0.4, math.nan])
def test_a_number_that_is_there_twice_is_one_or_not_known(other: float) -> None:
    heavy = SkillProperty("skiros.Weight", other)
    within = replace(GLASS, properties=(*GLASS.properties, heavy))
    beside = replace(GLASS, properties=(heavy,))
    for individuals in ((within,), (GLASS, beside), (beside, GLASS)):
        assert math.isnan(answer(WEIGHT, context(RunningSkill("Push", individuals))))
    depths = (SkillArgument("Depth", number=0.25), SkillArgument("Depth", number=other))
    assert math.isnan(answer(DEPTH, context(RunningSkill("Push", depths))))


@pytest.mark.parametrize(("count", "known"), [(64, True), (65, False)])
def test_a_message_that_is_too_large_is_not_read(count: int, known: bool) -> None:
    idle = RunningSkill("Drive")
    overfull = [
        crowd(count, idle),
        (replace(idle, arguments=crowd(count, SkillArgument("Speed"))),),
        (RunningSkill("Drive", (replace(GLASS, properties=crowd(count, GLASS.properties[0])),)),),
    ]
    for running in overfull:
        assert math.isnan(answer(PUSH, context(*running))) is not known


WRONG = {
    "nothing": None,
    "bytes": b"Push",
    "a list of nothing": [None],
    "a list of messages": [SimpleNamespace()],
    "a huge number": 10**400,
    "an object": object(),
}
FIELDS = ("digest", "running", "ahead", "skill", "arguments", "parameter", "type", "number",
          "properties", "property")  # fmt: skip


@pytest.mark.parametrize("wrong", WRONG.values(), ids=WRONG)
@pytest.mark.parametrize("name", FIELDS)
def test_what_is_not_as_defined_is_not_known(name: str, wrong: object) -> None:
    weight = SimpleNamespace(property="skiros.Weight", number=0.3)
    argument = SimpleNamespace(
        parameter="Object", value="", type="skiros.Glass", number=math.nan, properties=[weight]
    )
    skill = SimpleNamespace(skill="Push", arguments=[argument])
    message = SimpleNamespace(digest=DIGEST, running=[skill], ahead=[], is_ahead_known=True)
    assert (answer(FRAGILE, message), answer(WEIGHT, message)) == (1.0, 0.3)
    owner = next(each for each in (weight, argument, skill, message) if hasattr(each, name))
    setattr(owner, name, wrong)
    assert math.isnan(answer(FRAGILE, message))
    assert math.isnan(answer(WEIGHT, message))


@pytest.mark.parametrize("known", [None, 1, "True"])
def test_what_is_ahead_is_not_known_by_anything_else_than_a_proposition(known: object) -> None:
    message = SimpleNamespace(digest=DIGEST, running=[], ahead=[], is_ahead_known=known)
    assert math.isnan(answer(replace(PUSH, is_ahead=True), message))
    assert answer(PUSH, message) == 0.0


def test_a_skill_ahead_fits_by_what_is_known_of_it() -> None:
    asked = replace(FRAGILE, is_ahead=True)
    box = replace(GLASS, type="skiros.Box")
    for arguments, is_yes in (((), 1.0), ((GLASS,), 1.0), ((box,), 0.0), ((box, GLASS), 1.0)):
        ahead = RunningSkill("Push", arguments, is_ahead=True)
        assert answer(asked, SkillContext.of(DIGEST, [ahead])) == is_yes
        assert answer(FRAGILE, SkillContext.of(DIGEST, [ahead])) == 0.0
    assert answer(asked, context(PUSHES)) == 0.0


@given(st.integers(0, 2**64))
def test_the_order_of_skills_and_arguments_says_nothing(seed: int) -> None:
    random = Random(seed)
    query, given = random_query(random), random_context(random)
    turned = tuple(replace(each, arguments=each.arguments[::-1]) for each in given.running[::-1])
    there, back = answer(query, given), answer(query, replace(given, running=turned))
    assert there == back or (math.isnan(there) and math.isnan(back))


def test_a_query_is_shown_as_it_is_written() -> None:
    shown = "doing Push or PushGently(Object: skiros.Fragile or skiros.Glass)"
    assert path_words((FRAGILE,)) == str(FRAGILE) == shown
    assert path_text((FRAGILE,)) == f".{shown}"
    assert str(replace(FRAGILE, written="doing Push(Object: Fragile)")).endswith(
        "(Object: Fragile)"
    )
    assert [str(PUSH), str(WEIGHT), str(DEPTH)] == [
        "doing Push or PushGently", "Push.Object.skiros.Weight", "Push.Depth",
    ]  # fmt: skip


REAL, FLAG = ir.FieldKind.REAL, ir.FieldKind.FLAG


def asking(path: ir.Path, kind: ir.FieldKind) -> ir.Machine:
    draft = Draft()
    draft.input(draft.channel())
    draft.slots.append(ir.Slot(0, path, kind, 1.0, 0.0, ""))
    return draft.machine()


@pytest.mark.parametrize("step", [FRAGILE, PUSH, WEIGHT, DEPTH])
def test_a_query_is_kept_as_json(step: SkillStep) -> None:
    machine = asking((step,), FLAG if isinstance(step, Doing) else REAL)
    ir.verify(machine)
    assert ir.machine_from_json(ir.machine_to_json(machine)).slots == machine.slots


NOT_SORTED = "names that are not sorted, or none"
BACKWARDS = (("b", ("x",)), ("a", ("x",)))


@pytest.mark.parametrize(
    ("path", "kind", "said"),
    [
        ((PUSH,), REAL, "an answer of the kind real"),
        ((DEPTH,), FLAG, "a quantity of the kind flag"),
        ((replace(DEPTH, is_boolean=True),), REAL, "a quantity of the kind real"),
        (("data", PUSH), FLAG, "a query to skills inside a message"),
        ((replace(PUSH, skills=()),), FLAG, NOT_SORTED),
        ((replace(WEIGHT, skills=("b", "a")),), REAL, NOT_SORTED),
        ((replace(PUSH, arguments=BACKWARDS),), FLAG, "unsorted parameters"),
    ],
)
def test_a_query_that_cannot_be_is_refused(path: ir.Path, kind: ir.FieldKind, said: str) -> None:
    with pytest.raises(ir.MalformedMachine, match=f"slot 0: {said}"):
        ir.verify(asking(path, kind))
