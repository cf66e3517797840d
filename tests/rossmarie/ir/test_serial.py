"""Machines as JSON: nothing is lost, and nothing else is read."""

import json
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.ir import reactions
from support.c99_cases import reacting
from support.depth import examples
from support.drafts import Draft
from support.machines import machines
from support.plans import call
from support.reacting import reacting_machines


@settings(max_examples=examples(2))
@given(st.one_of(machines(), reacting_machines()))
@example(reacting())
def test_round_trip(machine: ir.Machine) -> None:
    text = ir.machine_to_json(machine)
    again = ir.machine_from_json(text)
    ir.verify(again)
    assert ir.machine_to_json(again) == text
    assert ir.dump_text(again) == ir.dump_text(machine)


def test_numbers_keep_every_bit() -> None:
    draft = Draft()
    values = (0.1, -0.0, 5e-324, 1.7976931348623157e308, 1e16, 3.0)
    for value in values:
        draft.constant(value)
    again = ir.machine_from_json(ir.machine_to_json(draft.machine()))
    nodes = [signal.node for signal in again.signals]
    assert list(map(repr, nodes)) == [repr(ir.Constant(value)) for value in values]


def test_spans_keep_their_sources() -> None:
    draft = Draft()
    draft.proposition(ir.Literal(True))
    again = ir.machine_from_json(ir.machine_to_json(draft.machine()))
    assert str(again.propositions[0].span) == "draft.ross:1:1"
    assert again.propositions[0].span.text == "draft"


def test_what_is_sent_keeps_its_kind() -> None:
    values: tuple[reactions.Scalar | tuple[reactions.Scalar, ...], ...] = (
        True, 1.0, "1", (True, 1.0, "1"), (),
    )  # fmt: skip
    assignments = tuple(reactions.Assignment(("a", 0), value) for value in values)
    found = reacting().reactions
    task = replace(found.tasks[4], effect=replace(call(), assignments=assignments))
    tasks = (*found.tasks[:4], task, *found.tasks[5:])
    machine = replace(reacting(), reactions=replace(found, tasks=tasks))
    again = ir.machine_from_json(ir.machine_to_json(machine))
    assert repr(again.reactions.tasks[4].effect) == repr(task.effect)


def readable() -> dict[str, Any]:
    draft = Draft()
    draft.rule(draft.above(draft.read(), 1.0))
    members: dict[str, Any] = json.loads(ir.machine_to_json(draft.machine()))
    return members


def test_other_versions_are_refused() -> None:
    for member, value in (("version", 1), ("format", "something")):
        with pytest.raises(ir.UnreadableMachine, match="not version 11 of a rossmarie-machine"):
            ir.machine_from_json(json.dumps({**readable(), member: value}))


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("machine", "rules"), 3),
        (("machine", "rules"), [{}]),
        (("machine", "propositions", 0, "node", "class"), "Rate"),
        (("machine", "propositions", 0, "node", "class"), "Nothing"),
        (("machine", "propositions", 0, "node", "comparison"), "=>"),
        (("machine", "propositions", 0, "node", "left"), 0.5),
        (("machine", "propositions", 0, "node", "left"), True),
        (("machine", "propositions", 0, "name"), 1),
        (("machine", "propositions", 0, "span"), [7, 0, 1]),
        (("machine", "propositions", 0, "span"), "here"),
        (("machine", "signals", 1, "node", "value"), "1"),
        (("machine", "texts"), {}),
        (("machine", "rules", 0, "priority"), 1),
        (("machine", "watches"), [0.5]),
        (("machine", "rules", 0, "documentation"), []),
        (("machine", "reactions", "order"), None),
        (("files",), [{}]),
    ],
)
def test_what_is_no_machine_is_refused(path: tuple[str | int, ...], value: object) -> None:
    whole = readable()
    place: Any = whole
    for step in path[:-1]:
        place = place[step]
    place[path[-1]] = value
    with pytest.raises(ir.UnreadableMachine):
        ir.machine_from_json(json.dumps(whole))


@given(st.text(max_size=20) | st.sampled_from(("null", "[]", "{}", "3", "[" * 100_000)))
def test_any_text_is_read_or_refused(text: str) -> None:
    with pytest.raises(ir.UnreadableMachine):
        ir.machine_from_json(text)
