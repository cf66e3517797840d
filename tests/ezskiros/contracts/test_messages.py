"""The full messages of findings about contracts."""

from __future__ import annotations

from pathlib import Path

import pytest

from dslkit.diagnostics.render_text import render_text
from ezskiros.driver import check_paths
from ezskiros.ontology.load import VARIABLE
from support.golden import assert_golden
from support.skills import ONTOLOGY

GOLDEN = Path(__file__).parent / "golden"
FIXTURES = ONTOLOGY.parent
CODES = range(550, 561)


@pytest.mark.parametrize("row", ["sequence", "selector", "parallel", "hold"])
def test_messages_are_as_somebody_has_seen_them(
    row: str, monkeypatch: pytest.MonkeyPatch, bless: bool
) -> None:
    monkeypatch.setenv(VARIABLE, str(ONTOLOGY))
    found = check_paths([FIXTURES / f"contracts_{row}.py"]).diagnostics
    reported = [each for each in found if int(each.code.removeprefix("EZS")) in CODES]
    text = render_text(reported).plain.replace(f"{FIXTURES}/", "")
    assert_golden(GOLDEN / f"{row}.txt", text, bless=bless)
