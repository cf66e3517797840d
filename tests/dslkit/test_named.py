"""The uses of a name that an expression is assigned to."""

from __future__ import annotations

import pytest

from dslkit.source import SourceFile, Span
from dslkit.source.named import uses_of

MODULE = """\
skirs = world.skirs
cora, rparts = world.cora, world.rparts

class Drive:
    def description(self, Robot: cora.Robot, Place: skirs.Location):
        return skirs.at(Robot, "ß", rparts)
"""


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("world.skirs", [5, 6]),
        ("world.cora", [5]),
        ("world.rparts", [6]),
        ('skirs.at(Robot, "ß", rparts)', []),
        ("world", []),
    ],
)
def test_uses_are_found_in_order(text: str, lines: list[int]) -> None:
    file = SourceFile("drive.py", MODULE)
    start = MODULE.index(text)
    found = uses_of(Span(file, start, start + len(text)))
    assert [each.begin.line for each in found] == lines


def test_a_file_that_is_not_python_has_no_uses() -> None:
    file = SourceFile("drive.py", "world.skirs (")
    assert uses_of(Span(file, 0, 11)) == []
