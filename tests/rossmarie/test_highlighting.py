"""The colours of rules files: all files are understood, and keywords depend on their places."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from pygments.lexers import get_lexer_by_name, get_lexer_for_filename
from pygments.token import Comment, Error, Keyword, Name, String

from rossmarie.highlighting import RossLexer, keywords
from support.markdown import blocks

ROOT = Path(__file__).parents[2]
RULES = sorted([*ROOT.glob("examples/**/*.ross"), *ROOT.glob("src/**/*.ross")])
SHEET = ROOT / "docs" / "reference" / "cheat-sheet.md"


def coloured(text: str) -> list[tuple[object, str]]:
    """The pieces of a text that are not white space, each with its kind."""
    return [(kind, piece) for kind, piece in RossLexer().get_tokens(text) if piece.strip()]


def kinds(text: str, word: str) -> list[object]:
    """The kinds of a word, at each of its places."""
    return [kind for kind, piece in coloured(text) if piece == word]


@pytest.mark.parametrize("path", RULES, ids=lambda path: str(path.relative_to(ROOT)))
def test_all_of_a_file_is_coloured(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    found = list(RossLexer(stripnl=False, ensurenl=False).get_tokens(text))
    assert "".join(piece for _, piece in found) == text
    assert [piece for kind, piece in found if kind is Error] == []


def test_each_keyword_is_coloured_where_the_cheat_sheet_has_it() -> None:
    sheet = SHEET.read_text(encoding="utf-8")
    code = "\n".join(block.text for block in blocks(sheet) if block.language == "ross")
    found = {piece for kind, piece in coloured(code) if kind in Keyword}
    left = keywords() - found
    assert left == {"down", "false", "messages", "replan"}
    assert [word for word in left if not re.search(rf"`[^`\n]*\b{word}\b[^`\n]*`", sheet)] == []


@pytest.mark.parametrize(
    "text",
    [
        "action stop { block /cmd_vel; }",
        "rule near: if gap < 1 m then { slow; also stop else stop; };",
        "rule near: if stop.active and not stop then { };",
        "const stop = 1 m",
        "expect near active at 1 sec, stop = 1 m;",
    ],
)
def test_a_free_word_is_a_name_where_it_names_something(text: str) -> None:
    assert kinds(text, "stop")
    assert [kind for kind in kinds(text, "stop") if kind not in Name] == []


def test_a_free_word_is_a_keyword_elsewhere() -> None:
    text = "action modes { switch /manager { stop effort; start position; } else stop; }"
    assert [kind in Keyword for kind in kinds(text, "stop")] == [True, False]
    assert kinds(text, "else") == [Keyword]


def test_values_have_units_and_fields_have_no_keywords() -> None:
    text = (
        "input gap = topic /front/scan : sensor_msgs/Range .range.timeout in km/h timeout 0.5 m/s^2"
    )
    assert (Keyword.Type, "m/s^2") in coloured(text)
    assert (Name.Class, "sensor_msgs/Range") in coloured(text)
    assert (Name.Variable.Global, "/front/scan") in coloured(text)
    assert kinds(text, "timeout") == [Name.Attribute, Keyword]
    assert (Keyword, "times") in coloured("oscillates(x, 6 times, within 2 sec)")


def test_comments_and_documentation_are_told_apart() -> None:
    text = "'''Why.'''\n// if\nconst a = \"if\""
    assert (String.Doc, "'''Why.'''") in coloured(text)
    assert (Comment.Single, "// if") in coloured(text)
    assert kinds(text, '"if"') == [String]


def test_programs_that_use_pygments_find_the_lexer() -> None:
    assert type(get_lexer_by_name("ross")).__name__ == "RossLexer"
    assert type(get_lexer_for_filename("near.ross")).__name__ == "RossLexer"
