"""A translated tree is the one that SkiROS2's `expand` builds."""

from __future__ import annotations

import tempfile
from pathlib import Path

from hypothesis import given, settings

from dslkit.diagnostics import Severity
from ezskiros.migrate.module import migrate_text
from support.depth import examples
from support.old_trees import HEAD, compounds
from support.round_trip import comments
from support.tree_round_trip import new_trees, old_trees

HERE = Path(__file__).parent
UNRELATED = ("EZS526", "EZS527", "EZS530", "EZS531", "EZS544")
"""Findings that each tree here has: the classes are unrelated, and children have missing values."""


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


def test_statements_below_a_chosen_processor_stay() -> None:
    """Python gives the identities of nodes that are gone to others."""
    numbers = range(150)
    branch = (
        "        if self.params['Careful'].value:\n            skill.setProcessor(SerialStar())\n"
    )
    body = "".join(f"{branch}        speed = {number}\n" for number in numbers)
    found = migrate_text("skills.py", f'{HEAD}{body}        skill(self.skill("Go", "go"))\n')
    kept = [line for line in found.text.splitlines() if line.startswith("        speed = ")]
    assert kept == [f"        speed = {number}" for number in numbers]


def test_a_processor_that_only_some_branches_choose() -> None:
    body = """\
        if self.params["Careful"].value:
            skill.setProcessor(Selector())
        skill(self.skill("Go", "go"))
"""
    found = migrate_text("skills.py", HEAD + body)
    assert found.unimplemented == ["do"]
    (problem,) = found.diagnostics
    assert problem.code == "EZS730"
    assert problem.title.startswith("a processor that only some branches choose")
    assert problem.primary.span.text == 'skill(self.skill("Go", "go"))'
    mark = found.text.splitlines().index(f"        # EZS730: {problem.title}")
    assert found.text.splitlines()[mark + 1] == '        skill(self.skill("Go", "go"))'


def test_children_that_are_added_twice_are_marked_where_they_are() -> None:
    line = '        skill(self.skill("Go", "go"))\n'
    found = migrate_text("skills.py", HEAD + line + line.replace('"go"', '""'))
    assert [each.code for each in found.diagnostics] == ["EZS728"]
    mark = f"        # EZS728: {found.diagnostics[0].title}\n"
    assert line + mark + line.replace('"go"', '""') in found.text


def test_a_method_that_calls_itself_is_left() -> None:
    body = """\
        skill(self.again())

    def again(self):
        return self.skill(Serial())(self.skill("Go", "go"), self.again())
"""
    found = migrate_text("skills.py", HEAD + body)
    assert {each.code for each in found.diagnostics} == {"EZS730"}
    assert found.unimplemented == ["do"]


@settings(max_examples=examples(0.4))
@given(compounds())
def test_any_tree_is_the_same(text: str) -> None:
    compare(text)


@settings(max_examples=examples(0.4))
@given(compounds())
def test_its_comments_stay(text: str) -> None:
    after = comments(migrate_text("skills.py", text).text)
    for comment in comments(text):
        after.remove(comment)
