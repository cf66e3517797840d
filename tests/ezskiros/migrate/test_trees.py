"""A translated tree is the one that SkiROS2's `expand` builds."""

from __future__ import annotations

import tempfile
from pathlib import Path

from hypothesis import given, settings

from dslkit.diagnostics import Severity
from ezskiros.migrate.module import migrate_text
from support.old_trees import compounds
from support.round_trip import comments
from support.tree_round_trip import new_trees, old_trees

HERE = Path(__file__).parent
UNRELATED = ("EZS526", "EZS527", "EZS530", "EZS531", "EZS544")
"""What is told of any tree here: the classes are unrelated, and children miss values."""


def compare(text: str) -> None:
    found = migrate_text("skills.py", text)
    assert not found.unimplemented, [each.title for each in found.diagnostics]
    with tempfile.TemporaryDirectory() as folder:
        new, checked = new_trees(found.text, text, Path(folder))
    assert new == old_trees(text)
    wrong = [each for each in checked.diagnostics if each.severity is Severity.ERROR]
    assert not [each.title for each in wrong if each.code not in UNRELATED]


def test_the_trees_of_an_example() -> None:
    compare((HERE / "before" / "trees.txt").read_text())


@settings(max_examples=40)
@given(compounds())
def test_any_tree_is_the_same(text: str) -> None:
    compare(text)


@given(compounds())
def test_its_comments_stay(text: str) -> None:
    after = comments(migrate_text("skills.py", text).text)
    for comment in comments(text):
        after.remove(comment)
