"""Habits from other languages cost one finding each, and the fix writes the intended text."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from dslkit.diagnostics import Collector, Diagnostic, apply_edits
from dslkit.source import SourceFile
from rossmarie.syntax import ast, parse
from rossmarie.syntax.grammar import Recognizer

Parsed = Callable[[str], tuple[ast.Module, tuple[Diagnostic, ...]]]

# Text, marked text, text after the fix.
MENDED = [
    ("rule slow down: if a then { b; }", "slow down", "rule slow_down: if a then { b; }"),
    ("rule slow-down: if a then { b; }", "slow-down", "rule slow_down: if a then { b; }"),
    ('rule "slow down": if a then { b; }', '"slow down"', "rule slow_down: if a then { b; }"),
    ("const max-speed = 3 m/s;", "max-speed", "const max_speed = 3 m/s;"),
    ("const max speed = 3 m/s;", "max speed", "const max_speed = 3 m/s;"),
    ("input max-speed = topic /t : p/T", "max-speed", "input max_speed = topic /t : p/T"),
    ("entity slow-down { a : b; }", "slow-down", "entity slow_down { a : b; }"),
    ("action slow-down;", "slow-down", "action slow_down;"),
    ("rule a: iff speed > 1 m/s then { b; }", "iff", "rule a: if speed > 1 m/s then { b; }"),
    ("rule a: when speed > 1 m/s then { b; }", "when", "rule a: if speed > 1 m/s then { b; }"),
    ("input x = topik /x : p/T", "topik", "input x = topic /x : p/T"),
    ("input x = topic /x : p/T timout 1 s", "timout", "input x = topic /x : p/T timeout 1 s"),
    ("input x = topic /x : p/T timeouts 1 s", "timeouts", "input x = topic /x : p/T timeout 1 s"),
    ("if a then { b; } lached until reset", "lached", "if a then { b; } latched until reset"),
    ("if a then { b; } claer for 2 s", "claer", "if a then { b; } clear for 2 s"),
    ("system s { node n { publish /t; } }", "publish", "system s { node n { publishes /t; } }"),
    ("rule a { if flag then { stop; }; }", "{", "rule a: if flag then { stop; }; "),
    ("entity d ( p : flag; )", "(", "entity d { p : flag; }"),
    ("entity d = { p : flag; }", "=", "entity d { p : flag; }"),
    ("if flag then { stop(); }", "()", "if flag then { stop; }"),
    ("if flag then stop;", "then stop", "if flag then { stop; };"),
    ("if flag then stop", "then stop", "if flag then { stop; }"),
    ("rule a: if flag then stop;", "then stop", "rule a: if flag then { stop; };"),
    ("if flag -> stop;", "-> stop", "if flag then { stop; };"),
    ("if a -> { b; }", "->", "if a then { b; }"),
    ("if a => { b; }", "=>", "if a then { b; }"),
    ("if a do { b; }", "do", "if a then { b; }"),
    ("if a when { b; }", "when", "if a then { b; }"),
    ("if a: { b; }", ":", "if a then { b; }"),
    ("if (a): { b; }", ":", "if (a) then { b; }"),
    ("rule r: if a\nthe { b; }", "the", "rule r: if a\nthen { b; }"),
    ("if flag; then { stop; }", ";", "if flag then { stop; }"),
    ("if flag then; { stop; }", ";", "if flag then { stop; }"),
    ("const a = [-10; 10] deg", ";", "const a = [-10, 10] deg"),
    ("if x in [-10; 10] deg then { stop; }", ";", "if x in [-10, 10] deg then { stop; }"),
    ("if x in [-10..10] deg then { stop; }", "..", "if x in [-10, 10] deg then { stop; }"),
    ("entity e { a : x in [-10; 10] deg; }", ";", "entity e { a : x in [-10, 10] deg; }"),
    ("const float lim = 3", "float", "const lim = 3"),
    (
        '"""doc""" rule a: if flag then { stop; }',
        '"""doc"""',
        "'''doc''' rule a: if flag then { stop; }",
    ),
    ('"doc" rule a: if flag then { stop; }', '"doc"', "'''doc''' rule a: if flag then { stop; }"),
    (
        'input x = topic /t timeout 1 sec\n"doc"\nrule a: if flag then { stop; }',
        '"doc"',
        "input x = topic /t timeout 1 sec\n'''doc'''\nrule a: if flag then { stop; }",
    ),
    (
        'input x = topic /t timeout 1 sec\n"""doc"""\nrule a: if flag then { stop; }',
        '"""doc"""',
        "input x = topic /t timeout 1 sec\n'''doc'''\nrule a: if flag then { stop; }",
    ),
    ("entity d { fast : if speed > 1 m/s; }", "if", "entity d { fast : speed > 1 m/s; }"),
    ("const a = 1 m/s**2", "**", "const a = 1 m/s^2"),
    ("const a = 1 [m/s]", "[m/s]", "const a = 1 m/s"),
    ("if speed not [1,2] m/s then { stop; }", "not", "if speed not in [1,2] m/s then { stop; }"),
    (
        "if speed between 1 and 2 then { stop; }",
        "between 1 and 2",
        "if speed in [1, 2] then { stop; }",
    ),
    ("if a is not b then { stop; }", "is not", "if a != b then { stop; }"),
    ("if a is b then { stop; }", "is", "if a == b then { stop; }"),
    ("const a = +1", "+", "const a = 1"),
    ("const a = 1_000", "1_000", "const a = 1000"),
    ("input x = topic /x : std_msgs::Float64", "::", "input x = topic /x : std_msgs/Float64"),
    ("input x = topic imu/data : p/T", "imu/data", "input x = topic /imu/data : p/T"),
    ("system s { topic a/b/c : p/T; }", "a/b/c", "system s { topic /a/b/c : p/T; }"),
    ("input x = topic /x : Float64", "Float64", "input x = topic /x : std_msgs/Float64"),
    ("if x in (-10, 10) deg then { stop; }", "(", "if x in [-10, 10] deg then { stop; }"),
    ("if mode == 'auto' then { stop; }", "'auto'", 'if mode == "auto" then { stop; }'),
    (
        "if mode == \u201cauto\u201d then { stop; }",
        "\u201cauto\u201d",
        'if mode == "auto" then { stop; }',
    ),
    ("const a = \u20131 m", "\u2013", "const a = -1 m"),
    ("const a = b \u2013 c", "\u2013", "const a = b - c"),
]

# Text, marked text.
EXPLAINED = [
    ("input x, y = topic /t : p/T", ", y"),
    ("latched rule b: if flag then { stop; }", "latched"),
    ("input x = topic /imu-data : p/T", "/imu-data"),
    ("input x = topic front-left/scan : p/T", "front-left/scan"),
    ("system s { topic /a/b-c-d : p/T; }", "/a/b-c-d"),
    ("if a xor b then { stop; }", "xor"),
    ("if cnt % 2 == 0 then { stop; }", "%"),
]


@pytest.mark.parametrize(("text", "marked", "mended"), MENDED)
def test_a_habit_is_found_once_and_its_fix_mends_it(
    parsed: Parsed, text: str, marked: str, mended: str
) -> None:
    _, found = parsed(text)
    assert [(one.code, one.primary.span.text) for one in found] == [("ROSS027", marked)]
    assert found[0].fix is not None
    assert apply_edits(text, found[0].fix.edits) == mended
    assert parsed(mended)[1] == ()


@pytest.mark.parametrize(("text", "marked"), EXPLAINED)
def test_a_habit_without_a_certain_remedy_is_found_once(
    parsed: Parsed, text: str, marked: str
) -> None:
    _, found = parsed(text)
    assert [(one.code, one.primary.span.text) for one in found] == [("ROSS027", marked)]
    assert found[0].help


NAMED_LIKE_THEN = [
    "entity them { a : b > ; }",
    "entitty them { a : b; }",
    "system them { node ten { publishes; } }",
    "if them then { ten; } clear for",
    "rule them { a; }",
]


@pytest.mark.parametrize("text", NAMED_LIKE_THEN)
def test_a_name_that_looks_like_then_is_a_name(parsed: Parsed, text: str) -> None:
    _, found = parsed(text)
    assert found
    assert all(one.code != "ROSS027" for one in found)


def test_an_item_that_parses_is_read_once(monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[int] = []
    run = Recognizer.run

    def counted(self: Recognizer, start: str, first: int, *rest: Any) -> Any:
        read.append(first)
        return run(self, start, first, *rest)

    monkeypatch.setattr(Recognizer, "run", counted)
    good = "if a then { b; }\n"
    parse(SourceFile("rules.ross", f"{good * 20}if a the {{ b; }}\n{good * 20}"), Collector())
    assert len(read) == 42  # each of the 41 rules, and the broken one again when it is mended


@pytest.mark.parametrize(
    "effect",
    ["tree Go within 3 sec", "send p/Goal { } to /x within 3 sec", "cancel /x within 1 sec"],
)
def test_a_word_behind_the_time_of_a_goal_is_no_action(parsed: Parsed, effect: str) -> None:
    _, found = parsed(f"action a {{ {effect} then reboot else halt; }}")
    assert [each.code for each in found] == ["ROSS018"]


def test_an_open_string_is_closed_in_front_of_then(parsed: Parsed) -> None:
    text = 'if mode == "auto then { stop; };'
    (found,) = parsed(text)[1]
    assert found.fix is not None
    assert apply_edits(text, found.fix.edits) == 'if mode == "auto" then { stop; };'


def test_there_are_no_escapes(parsed: Parsed) -> None:
    (found,) = parsed('if mode == "a\\"b" then { stop; };')[1]
    assert (found.code, found.fix) == ("ROSS003", None)
    assert "no escapes" in (found.help or "")
