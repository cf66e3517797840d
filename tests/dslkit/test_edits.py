"""Texts after a fix is applied."""

from __future__ import annotations

import pytest

from dslkit.diagnostics import Edit, apply_edits
from dslkit.source import SourceFile, Span

FILE = SourceFile("x.ross", "abcdef")


def edit(start: int, end: int, replacement: str) -> Edit:
    return Edit(Span(FILE, start, end), replacement)


def test_edits_are_applied_together_in_any_order() -> None:
    edits = [edit(4, 6, "EF!"), edit(0, 1, ""), edit(2, 2, "+")]
    assert apply_edits(FILE.text, edits) == "b+cdEF!"


def test_edits_may_touch() -> None:
    assert apply_edits(FILE.text, [edit(0, 3, "x"), edit(3, 6, "y")]) == "xy"


def test_edits_that_overlap_are_refused() -> None:
    with pytest.raises(ValueError, match="offset 1"):
        apply_edits(FILE.text, [edit(0, 3, "x"), edit(1, 2, "y")])
