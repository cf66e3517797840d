"""The trees of the fixtures, checked once."""

from __future__ import annotations

import pytest

from dslkit.diagnostics import Severity
from ezskiros.driver import Checked
from support.tree_files import checked


@pytest.fixture(scope="module")
def gripping() -> Checked:
    found = checked()
    wrong = [each for each in found.diagnostics if each.severity is Severity.ERROR]
    assert [str(each) for each in wrong] == []
    return found
