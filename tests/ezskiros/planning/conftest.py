"""The skills of the fixtures, checked once."""

from __future__ import annotations

import pytest

from ezskiros.driver import Checked
from support.tree_files import checked


@pytest.fixture(scope="module")
def gripping() -> Checked:
    found = checked()
    assert [str(each) for each in found.diagnostics] == []
    return found
