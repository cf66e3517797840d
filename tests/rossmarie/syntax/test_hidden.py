"""Characters that make a file look different from its meaning are errors."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from dslkit.diagnostics import Diagnostic, apply_edits
from rossmarie.syntax import ast

Parsed = Callable[[str], tuple[ast.Module, tuple[Diagnostic, ...]]]

RULES = "// rules\raction stop;\rrule a: if s then { stop; };\r"
LINE_BREAKS = "\v\f\x85\u2028\u2029"
BIDIRECTIONAL = "\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"


def mended(text: str, found: tuple[Diagnostic, ...]) -> str:
    edits = [edit for one in found if one.fix is not None for edit in one.fix.edits]
    return apply_edits(text, edits)


def test_a_carriage_return_ends_a_comment_and_is_an_error(parsed: Parsed) -> None:
    module, found = parsed(RULES)
    assert [(one.code, one.primary.span.start) for one in found] == [("ROSS026", 8)]
    assert [type(item) for item in module.items] == [ast.Action, ast.Rule]
    assert mended(RULES, found) == RULES.replace("\r", "\n")
    assert parsed(mended(RULES, found))[1] == ()


def test_a_lone_carriage_return_among_windows_line_ends_hides_nothing(parsed: Parsed) -> None:
    module, found = parsed("action stop;\r\n// note\rrule hidden: if s then { stop; };\r\n")
    assert [(one.code, str(one.primary.span)) for one in found] == [("ROSS026", "rules.ross:2:8")]
    assert [type(item) for item in module.items] == [ast.Action, ast.Rule]
    assert parsed("action stop;\r\n// note\r\nrule a: if s then { stop; };\r\n")[1] == ()


@pytest.mark.parametrize("letter", [*LINE_BREAKS, *BIDIRECTIONAL])
@pytest.mark.parametrize(
    "text",
    [
        "// a~b\naction stop",
        "'''a~b''' action stop",
        'const a = "b~c"',
        "const a = 3~\nconst b = 4",
    ],
)
def test_a_hidden_character_is_an_error_everywhere(parsed: Parsed, text: str, letter: str) -> None:
    written = text.replace("~", letter)
    _, found = parsed(written)
    assert [(one.code, one.primary.span.text) for one in found] == [("ROSS026", letter)]
    assert letter not in mended(written, found)
    assert parsed(mended(written, found))[1] == ()


@pytest.mark.parametrize("letter", LINE_BREAKS)
def test_words_do_not_grow_together_when_a_line_break_goes(parsed: Parsed, letter: str) -> None:
    text = f"const a = 3{letter}const b = 4"
    assert mended(text, parsed(text)[1]) == "const a = 3\nconst b = 4"
