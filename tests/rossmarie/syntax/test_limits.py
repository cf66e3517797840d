"""Bounds: what is too large, too deep or too wrong is said to be so, in little time."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from dslkit.diagnostics import Diagnostic
from rossmarie.syntax import MAXIMUM_FILE_SIZE, ast, format_module
from rossmarie.syntax.limits import MAXIMUM_DEPTH, MAXIMUM_ERRORS, MAXIMUM_NESTING
from rossmarie.syntax.walk import depth, expressions
from support.depth import deep
from support.effort import takes_at_most

Parsed = Callable[[str], tuple[ast.Module, tuple[Diagnostic, ...]]]

FULL = MAXIMUM_FILE_SIZE - 64


def entity(expression: str) -> str:
    return f"entity e {{ a : {expression}; b : c; }}"


def codes(found: tuple[Diagnostic, ...]) -> list[str]:
    return [one.code for one in found]


@pytest.mark.parametrize(
    ("opening", "closing"),
    [("(", ")"), ("not ", ""), ("- ", ""), ("!", ""), ("f(", ")"), ("- (", ")"), ("[", "]")],
)
def test_nesting_is_bounded(parsed: Parsed, opening: str, closing: str) -> None:
    levels = MAXIMUM_NESTING // sum(opening.count(sign) for sign in ("(", "[", "not", "-", "!"))
    _, found = parsed(entity(f"{opening * levels}x{closing * levels} > 3"))
    assert "ROSS012" not in codes(found)
    module, found = parsed(entity(f"{opening * (levels + 1)}x{closing * (levels + 1)} > 3"))
    assert "ROSS012" in codes(found)
    (saved,) = module.items
    assert isinstance(saved, ast.Entity)
    assert [condition.name.text for condition in saved.conditions] == ["a", "b"]
    assert isinstance(saved.conditions[0].expression, ast.Broken)


def test_brackets_beside_each_other_are_no_nesting(parsed: Parsed) -> None:
    text = " and ".join(["(not (x > -3))"] * 70)
    assert parsed(entity(text))[1] == ()


@pytest.mark.parametrize(
    "link", [" + x", " and x", " or x", ".x", "[0]", ".x()", " for 1 s", " * 2"]
)
def test_the_length_of_an_expression_is_bounded(parsed: Parsed, link: str) -> None:
    module, found = parsed(entity("x" + link * (MAXIMUM_DEPTH - 10)))
    assert found == ()
    assert format_module(module)
    module, found = parsed(entity("x" + link * (MAXIMUM_DEPTH + 1)))
    assert codes(found) == ["ROSS013"]
    (saved,) = module.items
    assert isinstance(saved, ast.Entity)
    assert isinstance(saved.conditions[0].expression, ast.Broken)


def test_whatever_is_accepted_can_be_walked_by_recursion(parsed: Parsed) -> None:
    inner = "x" + " + x" * 150
    for _ in range(20):
        inner = f"({inner}) + x"
    module, found = parsed(entity(inner))
    assert found == ()
    (item,) = module.items
    assert max(depth(root) for root in expressions(item)) <= MAXIMUM_DEPTH


def test_a_file_of_the_largest_size_is_read(parsed: Parsed) -> None:
    comment = "// é\n"
    text = comment * (MAXIMUM_FILE_SIZE // len(comment.encode()))
    padding = MAXIMUM_FILE_SIZE - len(text.encode())
    assert parsed(text + " " * padding)[1] == ()
    module, found = parsed(text + " " * (padding + 1))
    assert codes(found) == ["ROSS001"]
    assert module.items == ()


@pytest.mark.parametrize(
    "text",
    [
        "a;\n" * 1000,
        f"entity e {{ {'a : ;' * 1000} }} const x = 3",
        "if a then { " + "b b; " * 1000 + "}",
        "/* a */" * 1000,
        "const a = .5\n" * 1000,
        "if a THEN { b; }\n" * 1000,
    ],
)
def test_the_number_of_findings_is_bounded(parsed: Parsed, text: str) -> None:
    module, found = parsed(text)
    assert len(found) == MAXIMUM_ERRORS + 1
    assert module.items == ()  # of names declared further on, nothing is known


def test_as_many_findings_as_are_shown_are_not_too_many(parsed: Parsed) -> None:
    module, found = parsed("a;\n" * MAXIMUM_ERRORS + "action last;")
    assert codes(found) == ["ROSS005"] * MAXIMUM_ERRORS
    assert len(module.items) == 1


HUGE = {
    "chain": "const x = " + "a + " * (FULL // 4) + "a",
    "words": "const " * (FULL // 6),
    "parentheses": "const x = " + "((((    " * (FULL // 8),
    "not": "const x = " + "not " * (FULL // 4),
    "items": "action a;\n" * (FULL // 10),
    "entity": "entity e {" + "a : b > 3;" * (FULL // 10) + "}",
    "open entities": "entity e {\n" * (FULL // 11),
    "open actions": "action a {\n" * (FULL // 11),
    "rules": "if a then { b; }\n" * (FULL // 17),
    "one mistake": "if a then { b; }\n" * 37_000 + "if",
    "one long mistake": "entity e {" + "a : b > 3;" * 42_000,
    "misspelt": "entitty e {}\n" * (FULL // 13),
    "names": "ab cd\n" * (FULL // 6),
    "quotes": '"' * FULL,
    "documentation": "'" * FULL,
    "documentation and words": "''' x " * (FULL // 6),
    "digits": "const x = " + "1" * FULL,
    "exponent": "const x = 1e" + "9" * FULL,
    "unit": "const x = 3 " + "metre/" * (FULL // 6) + "s",
    "nul": "\0" * FULL,
    "braces": "{" * FULL,
    "stray": "} " * (FULL // 2),
    "comparisons": "const x = " + "ab < " * (FULL // 5),
    "spaces": " " * FULL,
    "pairs": "ab cd\n" * 149_000,
    "parts": "const a b\n" * 99_000,
    "conditions": "entity e {" + "a : b c;" * 59_000 + "}",
    "actions": "if a then {" + "a a; " * 74_000 + "}",
    "commas": "if a then {" + "a, " * 140_000 + "}",
    "contracts": "if a then {} " + "clear for " * 104_000,
    "capitals": "IF a THEN { b; };\n" * 33_000,
    "block comments": "/*" * (FULL // 2),
    "open block comments": "/*\n" * (FULL // 3),
    "points": "1. " * 299_000,
    "decimals": "1,5 " * 99_000,
    "arguments": "const x = f(" + "abc, " * (FULL // 5) + "a)",
}


LENGTHY = {
    *("actions", "arguments", "braces", "chain", "commas", "comparisons", "conditions", "entity"),
    *("items", "nul", "one long mistake", "one mistake", "rules"),
}
"""Files that take seconds to read: a part of each is enough to see how the time grows."""
IN_EACH_RUN = {"chain", "entity", "one mistake"} | HUGE.keys() - LENGTHY


@pytest.mark.parametrize(
    ("name", "share"),
    [
        *((name, 16 if name in LENGTHY else 8) for name in HUGE if name in IN_EACH_RUN),
        *deep((name, 1) for name in HUGE),
    ],
)
def test_huge_files_take_time_in_proportion(parsed: Parsed, name: str, share: int) -> None:
    assert len(HUGE[name]) <= MAXIMUM_FILE_SIZE
    text = HUGE[name][: MAXIMUM_FILE_SIZE // share]
    quarter = text[: len(text) // 4]
    assert takes_at_most(8, parsed, quarter, text)  # 16 times if it were quadratic
