"""Fixtures of the skill tests: the ontology of the example, and a folder for installed packages."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from ezskiros import session
from ezskiros.ontology.load import VARIABLE
from support.ontologies import HALL


@pytest.fixture
def hall(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let `load()` return the example ontology."""
    monkeypatch.setenv(VARIABLE, str(HALL))


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The folder of installed packages."""
    folder = tmp_path / "site" / "dist-packages"
    folder.mkdir(parents=True)
    monkeypatch.syspath_prepend(folder)
    monkeypatch.setattr(session, "LIBRARIES", (*session.LIBRARIES, f"{folder}{os.sep}"))
    known = {*sys.modules}
    yield folder
    for name in {*sys.modules} - known:
        del sys.modules[name]
