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
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
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
def test_a_broken_file_is_replaced(
    cache: Path, content: bytes, caplog: pytest.LogCaptureFixture
) -> None:
    first = loaded()
    (kept,) = (cache / "rossmarie").iterdir()
    good = kept.stat().st_size
    kept.write_bytes(content or kept.read_bytes()[: good // 3])
    assert rules(loaded()) == rules(first)
    assert kept.stat().st_size > good / 2
    assert f"{kept}: the content is not what was kept" in caplog.text


def test_without_a_place_for_them_they_are_built(cache: Path) -> None:
    cache.write_text("not a folder")
    assert rules(loaded())


def test_nobody_has_a_home(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def homeless() -> Path:
        raise RuntimeError("Could not determine home directory.")

    for variable in ("XDG_CACHE_HOME", "XDG_STATE_HOME"):
        monkeypatch.delenv(variable)
    monkeypatch.setattr(Path, "home", homeless)
    assert rules(loaded())
    assert not cache.exists()
