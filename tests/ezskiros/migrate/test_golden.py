"""Files of SkiROS2, and what they become."""

from __future__ import annotations

from functools import cache, partial
from pathlib import Path

from dslkit.diagnostics import Collector
from dslkit.diagnostics.render_text import render_text
from ezskiros.migrate.module import migrate_text
from support.golden import assert_golden
from support.round_trip import new_forms, old_forms, without_order, write_ontology

AFTER = Path(__file__).parent / "after"

migrated = cache(partial(migrate_text, "skills.py"))


def test_the_new_text(before: Path, bless: bool) -> None:
    found = migrated(before.read_text(encoding="utf-8"))
    assert_golden(AFTER / before.name, found.text, bless=bless)


def test_what_is_said(before: Path, bless: bool) -> None:
    collector = Collector()
    collector.extend(migrated(before.read_text(encoding="utf-8")).diagnostics)
    said = render_text(collector.sorted()).plain
    assert_golden(AFTER / f"{before.stem}.findings", said, bless=bless)


def test_once_is_enough(before: Path) -> None:
    once = migrated(before.read_text(encoding="utf-8"))
    twice = migrated(once.text)
    assert twice.text == once.text
    assert not twice.translated
    assert twice.left == once.left


def test_both_mean_the_same(before: Path, tmp_path: Path) -> None:
    text = before.read_text(encoding="utf-8")
    found = migrated(text)
    old = {name: form for name, form in old_forms(text).items() if name in found.translated}
    write_ontology(old.values(), tmp_path)
    new = new_forms(found.text, tmp_path)
    assert {name: without_order(new[name]) for name in old} == {
        name: without_order(form) for name, form in old.items()
    }
    assert list(old) == list(found.translated)
