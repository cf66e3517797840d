"""Skills with the findings that they are expected to have, all at once, through the whole check."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.ontology.load import VARIABLE
from support.skills import ONTOLOGY, compare_files

FILES = sorted(ONTOLOGY.parent.glob("*.py"))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_findings_are_as_expected(path: Path, monkeypatch: pytest.MonkeyPatch, bless: bool) -> None:
    monkeypatch.setenv(VARIABLE, str(ONTOLOGY))
    problems = compare_files([path], bless=bless)
    assert not problems, "\n".join(problems)
