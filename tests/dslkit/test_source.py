"""Offsets to lines and columns and back."""

from __future__ import annotations

import io

from hypothesis import given
from hypothesis import strategies as st

from dslkit.source import Position, SourceFile, Span

TEXTS = st.text(st.sampled_from("ab\n\r名"), max_size=30)


def lines_of(text: str) -> list[str]:
    """The lines with their ends, as Python reads them; behind a last end there is one more."""
    lines = io.StringIO(text, newline="").readlines()
    return [*lines, ""] if not lines or lines[-1].endswith(("\n", "\r")) else lines


@given(TEXTS, st.data())
def test_a_position_leads_back_to_its_offset(text: str, data: st.DataObject) -> None:
    offset = data.draw(st.integers(0, len(text)))
    position = SourceFile("x", text).position(offset)
    lines = lines_of(text)
    before = sum(len(line) for line in lines[: position.line - 1])
    assert before + position.column - 1 == offset
    assert 1 <= position.column <= len(lines[position.line - 1]) + 1


@given(TEXTS)
def test_lines_are_shown_without_their_ends(text: str) -> None:
    file = SourceFile("x", text)
    shown = [file.line_text(number + 1) for number in range(len(file.line_starts))]
    assert shown == [line.rstrip("\r\n") for line in lines_of(text)]
    assert file.line_text(len(shown) + 1) == ""


def test_a_span_knows_its_text_its_ends_and_its_neighbours() -> None:
    file = SourceFile("x.ross", "one\ntwo three")
    two, three = Span(file, 4, 7), Span(file, 8, 13)
    assert two.text == "two"
    assert (two.begin, three.finish) == (Position(2, 1), Position(2, 10))
    assert three.to(two).text == "two three"
    assert str(three) == "x.ross:2:5"
