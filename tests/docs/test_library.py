"""The page of the library says what its files say."""

from __future__ import annotations

from pathlib import Path

from support.library import page

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "library.md"


def test_the_page_is_that_of_the_files(bless: bool) -> None:
    if bless:
        PAGE.write_text(page(), encoding="utf-8")
    assert PAGE.read_text(encoding="utf-8") == page()
