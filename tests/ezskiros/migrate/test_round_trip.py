"""Any description means the same after it is translated, and has the same comments."""

from __future__ import annotations

import tempfile
from pathlib import Path

from hypothesis import given, settings

from ezskiros.migrate.module import migrate_text
from support.depth import examples
from support.old_descriptions import descriptions
from support.round_trip import comments, new_forms, old_forms, without_order, write_ontology


@settings(max_examples=examples(0.4))
@given(descriptions())
def test_a_description_means_the_same(text: str) -> None:
    found = migrate_text("skills.py", text)
    assert found.translated == ["Skill"], [each.title for each in found.diagnostics]
    old = old_forms(text)["Skill"]
    with tempfile.TemporaryDirectory() as folder:
        write_ontology([old], Path(folder))
        new = new_forms(found.text, Path(folder))["Skill"]
    assert without_order(new) == without_order(old)


@settings(max_examples=examples(0.4))
@given(descriptions())
def test_a_description_keeps_its_comments(text: str) -> None:
    after = comments(migrate_text("skills.py", text).text)
    for comment in comments(text):
        after.remove(comment)


@settings(max_examples=examples(0.4))
@given(descriptions())
def test_a_second_migration_does_nothing(text: str) -> None:
    once = migrate_text("skills.py", text)
    assert migrate_text("skills.py", once.text).text == once.text
