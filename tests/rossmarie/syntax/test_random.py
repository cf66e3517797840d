"""Any text at all, texts that are nearly right, and every correct text."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

from hypothesis import example, given, settings
from hypothesis import strategies as st

from dslkit.diagnostics import Diagnostic
from dslkit.source import SourceFile
from rossmarie.syntax import ast, format_module, walk
from rossmarie.syntax.scan import scan
from rossmarie.syntax.walk import expressions
from rossmarie.syntax.words import RESERVED
from support.depth import examples

Parsed = Callable[[str], tuple[ast.Module, tuple[Diagnostic, ...]]]
WithoutSpans = Callable[[ast.Module], Any]

ROOT = Path(__file__).parents[3]
FIXTURES = ROOT / "tests" / "fixtures"
FOLDERS = (
    ROOT / "examples",
    FIXTURES / "actions",
    FIXTURES / "testing",
    FIXTURES / "skills",
    ROOT / "src",
)
PATHS = [path for folder in FOLDERS for path in sorted(folder.rglob("*.ross"))]
EXAMPLES = [path.read_text(encoding="utf-8") for path in PATHS]

WORDS = [
    *sorted(RESERVED),
    *("timeout", "clear", "when", "latched", "until", "reset", "times", "within", "by", "node"),
    *("a", "b.c", "/t", "p/T", "m/s", "deg", "3", "0.5", "1e999", '"text"', "//", "\n", "'''"),
    *"'\";:,.=<!+-*/()[]{}@\0\ud800é°%^",
    *("action a {", "limit", "publish", "cancel", "log", "ramp", "at", "to"),
    *("else", "also", "over", "priority"),
    *('test "a" {', "every", "from", "expect", "active", "unknown"),
    *("doing", "while", "unless", "always", "skills", "doing A(b: C)"),
    *("==", "&&", "||", "->", "=>", "oscillates", "messages", "unit"),
]

many = settings(max_examples=examples(4))


def check_invariants(parsed: Parsed, text: str) -> None:
    """For every text, spans lie inside the text, and broken parts have been reported."""
    module, found = parsed(text)
    for one in found:
        edits = one.fix.edits if one.fix else ()
        for span in (one.primary.span, *(edit.span for edit in edits)):
            assert 0 <= span.start <= span.end <= len(text)
    end = 0
    is_broken = False
    for item in module.items:
        assert end <= item.span.start < item.span.end <= len(text)
        end = item.span.end
        for root in expressions(item):
            for node in walk(root):
                assert item.span.start <= node.span.start <= node.span.end <= item.span.end
                is_broken = is_broken or isinstance(node, ast.Broken)
    assert found or not is_broken


@many
@given(text=st.text(max_size=60) | st.lists(st.sampled_from(WORDS), max_size=30).map(" ".join))
@example(text="rule")
@example(text="if then { ; } }")
@example(text="entity e { node : { } x }")
@example(text="x > '''\nconst a = 3 ''' const b")
def test_any_text_gives_a_module(parsed: Parsed, text: str) -> None:
    check_invariants(parsed, text)


@many
@given(data=st.data())
def test_any_change_of_a_correct_text_gives_a_module(parsed: Parsed, data: st.DataObject) -> None:
    text = data.draw(st.sampled_from(EXAMPLES))
    for _ in range(data.draw(st.integers(1, 4))):
        start = data.draw(st.integers(0, len(text)))
        length = data.draw(st.integers(0, 12))
        inserted = data.draw(st.sampled_from(["", " ", *WORDS]))
        text = text[:start] + inserted + text[start + length :]
    check_invariants(parsed, text)


@many
@given(data=st.data())
def test_a_mistake_in_one_item_leaves_the_others(parsed: Parsed, data: st.DataObject) -> None:
    """However an item on lines of its own is damaged, the ones around it are still there, unless
    the damage itself begins or ends an item, a text or a comment.
    """
    harmless = [word for word in WORDS if word not in ("'''", "{", "}", ";", "\n", "//", '"')]
    words = data.draw(st.lists(st.sampled_from(harmless), max_size=12))
    text = f"action first;\nconst c = {' '.join(words)}\naction second;\naction third;"
    module, _ = parsed(text)
    names = [item.name.text for item in module.items if isinstance(item, ast.Action)]
    assert names[0] == "first"
    assert names[-2:] == ["second", "third"]


# --- correct texts, as lists of words -------------------------------------------------------------

Words = st.SearchStrategy[list[str]]

NAMES = st.sampled_from(["a", "speed", "unit", "reset", "clear", "min", "m", "_x1", "within_2"])
FIELDS = NAMES | st.sampled_from(["in", "for", "rule", "if", "true"])
UNITS = st.sampled_from(["m", "m/s", "kgm.m", "deg", "%", "°C", "m/s^2", "N*m", "s^-1", "µm"])
NUMBERS = st.sampled_from(["0", "3", "4.0", "0.25", "1e3", "2.5E-3", "007"])
TYPES = st.sampled_from(["sensor_msgs/Imu", "a/msg/B"])
TOPICS = st.sampled_from(["/imu/data", "/t", "/a/b_2/c", "Wrench"])


def words(*parts: str | st.SearchStrategy[Any]) -> Words:
    """The words of all parts, one after the other."""
    lists = [st.just([part]) if isinstance(part, str) else part.map(_listed) for part in parts]
    return st.tuples(*lists).map(lambda drawn: [word for part in drawn for word in part])


def _listed(drawn: str | list[str]) -> list[str]:
    return [drawn] if isinstance(drawn, str) else drawn


def repeated(part: Words, most: int = 3) -> Words:
    return st.lists(part, max_size=most).map(lambda drawn: [word for one in drawn for word in one])


def optional(*parts: str | st.SearchStrategy[Any]) -> Words:
    return st.just([]) | words(*parts)


NUMBER = words(NUMBERS, optional(UNITS))
SIMPLE: Words = (
    NUMBER
    | words(NAMES)
    | st.sampled_from([["true"], ["false"], ['"text // \'"']])
    | words("[", "-", NUMBER, ",", NUMBER, "]", optional(UNITS))
    | words("count", "(", "edges", "of", NAMES, "within", NUMBER, ")")
    | words("oscillates", "(", NAMES, ",", "3", "times", ",", "within", NUMBER, ")")
)


def grown(inner: Words) -> Words:
    """Expressions one level larger; parenthesised, so that every choice is correct."""
    infix = st.sampled_from(
        ["or", "and", "==", "!=", "<", "<=", ">", ">=", "+", "-", "*", "/", "in", "for"]
    )
    operand = words("(", inner, ")")
    return (
        words(operand, infix, operand)
        | words(operand, "not", "in", operand)
        | words("not", inner.map(lambda drawn: drawn))
        | words("-", operand)
        | words("(", inner, ")", ".", FIELDS, ".", FIELDS, "(", ")", "[", "3", "]")
        | words(NAMES, "(", inner, ",", inner, ")")
    )


EXPRESSIONS = st.recursive(SIMPLE, grown, max_leaves=5)
SUMS = NUMBER | words(NAMES) | words("(", EXPRESSIONS, ")")
CONTRACTS = (
    words("clear", "when", EXPRESSIONS)
    | words("clear", "for", SUMS)
    | words("latched", "until", "reset")
)
END = st.sampled_from([[], [";"], [";", ";"]])
PATH = repeated(words(".", FIELDS), 2)
MEMBERS = (
    words("messages", '"msg"', ";")
    | words("topic", optional(NAMES, "="), TOPICS, ":", TYPES, optional("in", UNITS), ";")
    | words("unit", TYPES, ".", FIELDS, PATH, "=", UNITS, ";")
    | words(
        "node",
        NAMES,
        "{",
        repeated(words("publishes", TOPICS, repeated(words(",", TOPICS)), ";"), 2),
        repeated(words("subscribes", TOPICS, ";"), 2),
        "}",
        st.sampled_from([[], [";"]]),
    )
)
# Behind a number any word is a unit, and behind `at` and an instant `reset` is the keyword.
TIMES = words(NUMBERS, UNITS) | words("(", EXPRESSIONS, ")")
STRETCHES = words("from", TIMES, st.sampled_from(["to", "until"]), TIMES)
INPUTS = st.sampled_from(["a", "speed", "unit", "test", "at"])
VALUES = SUMS | st.just(["unknown"])
SETTINGS = words(INPUTS, PATH, st.sampled_from([[], ["[", "3", "]"]]), optional("=", VALUES))
STATEMENTS = (
    words("at", TIMES, SETTINGS, repeated(words(",", SETTINGS)), ";")
    | words("at", TIMES, "reset", optional(INPUTS), ";")
    | words("every", TIMES, STRETCHES, SETTINGS, ";")
    | words("expect", NAMES, "active", "at", TIMES, ";")
    | words("expect", NAMES, "inactive", STRETCHES, ";")
)
ITEMS = (
    words("import", '"a.ross"', END)
    | words("action", NAMES, END)
    | words("const", NAMES, "=", EXPRESSIONS, END)
    | words(
        "input",
        NAMES,
        "=",
        "topic",
        TOPICS,
        optional(":", TYPES),
        PATH,
        optional("in", UNITS),
        optional("timeout", SUMS),
        END,
    )
    | words("entity", NAMES, "{", repeated(words(NAMES, ":", EXPRESSIONS, ";")), "}", END)
    | words("system", NAMES, "{", repeated(MEMBERS), "}", END)
    | words("test", '"name"', "{", repeated(STATEMENTS), "}", END)
    | words(
        optional("rule", NAMES, ":"),
        "if",
        EXPRESSIONS,
        "then",
        "{",
        repeated(words(NAMES, ";")),
        "}",
        repeated(CONTRACTS, 2),
        END,
    )
)
GAPS = st.sampled_from(
    [" ", " ", " ", "\n", "\n\n\n", " // c\n", "\n// own\n\n", " '''d''' ", "\n'''d\n  e'''\r\n"]
)


@st.composite
def programs(draw: st.DrawFn) -> str:
    """A correct text, with comments and documentation in any place."""
    drawn = draw(st.lists(ITEMS, max_size=4))
    return "".join(word + draw(GAPS) for item in drawn for word in item)


@many
@given(text=programs())
@example(text='test "an input that is called at" { at 0 m at ; } ')
@example(text='const c = 0\nm test "a unit on a line of its own" { } ')
def test_formatting_keeps_the_tree_and_the_comments(
    parsed: Parsed, without_spans: WithoutSpans, text: str
) -> None:
    module, found = parsed(text)
    assert [(one.code, one.primary.span.text) for one in found] == []
    check_invariants(parsed, text)
    formatted = format_module(module)
    again, found = parsed(formatted)
    assert found == ()
    assert without_spans(again) == without_spans(module)
    assert format_module(again) == formatted
    assert not comments(text) - comments(formatted)


def comments(text: str) -> Counter[str]:
    found = scan(SourceFile("rules.ross", text)).trivia
    return Counter(one.text.rstrip() for one in found if one.kind == "comment")
