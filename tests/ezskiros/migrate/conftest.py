"""Common fixtures of the migration tests."""

from __future__ import annotations

from pathlib import Path

import pytest

HERE = Path(__file__).parent


@pytest.fixture(params=sorted(HERE.glob("before/*.txt")), ids=lambda path: path.stem)
def before(request: pytest.FixtureRequest) -> Path:
    """A file of SkiROS2, written for these tests."""
    path = request.param
    assert isinstance(path, Path)
    return path
