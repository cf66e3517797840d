"""Messages of ROS as plain data: nothing in them breaks a terminal or costs more than it may."""

from __future__ import annotations

import unicodedata
from types import SimpleNamespace as Message

from hypothesis import given, settings
from hypothesis import strategies as st

from crosscheck.live.model import NodeState, RunningCall, RunningContext
from crosscheck.live.reading import LONGEST_NAME, context_of, is_alive, state_of
from support.depth import examples

ACTING = {"Cc", "Cf", "Cs", "Zl", "Zp"}
"""Categories of characters that a terminal acts on."""


def argument(parameter: str, value: str = "", type: str = "") -> Message:  # noqa: A002
    return Message(parameter=parameter, value=value, type=type)


def skill(name: str, goal: str, *arguments: Message) -> Message:
    return Message(skill=name, goal=goal, arguments=list(arguments))


def test_a_context_is_read_with_its_arguments() -> None:
    reported = skill("Wipe", "1", argument("Board", "", "office.Board"), argument("Speed", "0.3"))
    found = context_of(Message(digest="5b", running=[reported]))
    assert found == RunningContext(
        "5b", (RunningCall("Wipe", "1", (("Board", "office.Board"), ("Speed", "0.3"))),)
    )


def test_an_argument_of_several_classes_is_reported_once() -> None:
    twice = [argument("Board", "a:B-1", kind) for kind in ("a.B", "a.C")]
    (running,) = context_of(Message(digest="", running=[skill("Wipe", "1", *twice)])).running
    assert running.arguments == (("Board", "a:B-1"),)


def test_what_the_rules_would_not_read_is_not_read() -> None:
    many = context_of(Message(digest="", running=[skill("A", str(each)) for each in range(65)]))
    assert many == RunningContext("", problem="more than 64 skills run")
    wide = skill("A", "1", *(argument(str(each)) for each in range(65)))
    found = context_of(Message(digest="", running=[wide]))
    assert found == RunningContext("", problem="a skill has more than 64 arguments")


@settings(max_examples=examples(1))
@given(st.text(max_size=300))
def test_any_name_can_be_shown(name: str) -> None:
    context = context_of(Message(digest=name, running=[skill(name, name, argument(name, name))]))
    state = state_of(Message(active=[name], exempted=[name]))
    (running,) = context.running
    for each in (context.digest, running.skill, running.goal, *running.arguments[0], *state.active):
        assert {unicodedata.category(character) for character in each}.isdisjoint(ACTING)
        assert len(each) <= len("<U+10FFFF>") * LONGEST_NAME + 3


def test_a_name_as_long_as_a_film_is_cut() -> None:
    assert state_of(Message(active=["a" * 10**7], exempted=[])) == NodeState(
        ("a" * LONGEST_NAME + "...",)
    )


def test_a_node_is_known_by_its_full_name() -> None:
    found = Message(status=[Message(hardware_id="robot1/whiteboard_safety")])
    assert is_alive(found, "/robot1/whiteboard_safety")
    assert not is_alive(found, "/whiteboard_safety")
    assert not is_alive(Message(status=[]), "/robot1/whiteboard_safety")
