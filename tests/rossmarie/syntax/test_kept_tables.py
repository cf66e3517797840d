"""The tables of the parser are kept between runs, and whatever is in their file does no harm."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import lark.lark
import pytest

from rossmarie.syntax.grammar import Grammar, load_grammar


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The user's cache folder; it does not exist yet."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    load_grammar.cache_clear()
    yield tmp_path / "cache"
    load_grammar.cache_clear()


def loaded() -> Grammar:
    """The grammar as a new process loads it."""
    load_grammar.cache_clear()
    return load_grammar()


def rules(grammar: Grammar) -> set[str]:
    return {str(rule) for rule in grammar.lark.rules}


def test_tables_are_built_once(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = loaded()
    (kept,) = (cache / "rossmarie").iterdir()
    assert kept.stat().st_size > 10_000

    def build(*_arguments: object) -> None:
        raise AssertionError("the tables are built anew")

    monkeypatch.setattr(lark.lark, "load_grammar", build)
    assert rules(loaded()) == rules(first)
    assert loaded().literals == first.literals


@pytest.mark.parametrize("content", [b"", b"nonsense", b"\x80\x04."])
def test_a_broken_file_is_replaced(cache: Path, content: bytes) -> None:
    first = loaded()
    (kept,) = (cache / "rossmarie").iterdir()
    good = kept.stat().st_size
    kept.write_bytes(content or kept.read_bytes()[: good // 3])
    assert rules(loaded()) == rules(first)
    assert kept.stat().st_size > good / 2


def test_without_a_place_for_them_they_are_built(cache: Path) -> None:
    cache.write_text("not a folder")
    assert rules(loaded())


def test_nobody_has_a_home(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def homeless() -> Path:
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setattr(Path, "home", homeless)
    assert rules(loaded())
    assert not cache.exists()


def test_nothing_is_taken_from_a_folder_that_others_may_write_to(cache: Path) -> None:
    (cache / "rossmarie").mkdir(parents=True)
    (cache / "rossmarie").chmod(0o777)
    assert rules(loaded())
    assert list((cache / "rossmarie").iterdir()) == []
