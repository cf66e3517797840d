"""The pages about the library match its files and the included robots."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import pytest

from support import library, library_reuse

REFERENCE = Path(__file__).parents[2] / "docs" / "reference"


@pytest.mark.parametrize("module", [library, library_reuse], ids=["library", "library-reuse"])
def test_a_page_is_that_of_the_files(module: ModuleType, bless: bool) -> None:
    page = REFERENCE / f"{module.__name__.rpartition('.')[2].replace('_', '-')}.md"
    if bless:
        page.write_text(module.page(), encoding="utf-8")
    assert page.read_text(encoding="utf-8") == module.page()
