"""The tables of the parser are kept between runs, and whatever is in their file does no harm."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from rossmarie.syntax import grammar
from rossmarie.syntax.grammar import load_tables
from rossmarie.syntax.tables import Reduction, Tables


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The user's cache folder; it does not exist yet."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    load_tables.cache_clear()
    yield tmp_path / "cache"
    load_tables.cache_clear()


def loaded() -> Tables:
    """The tables as a new process loads them."""
    load_tables.cache_clear()
    return load_tables()


def rules(tables: Tables) -> set[Reduction]:
    """The reductions, which do not depend on lark's numbering of the states."""
    return set(tables.reductions)


def test_tables_are_built_once(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = loaded()
    (kept,) = (cache / "rossmarie").iterdir()
    assert kept.stat().st_size > 10_000

    def build(*_arguments: object) -> bytes:
        raise AssertionError("the tables are built anew")

    monkeypatch.setattr(grammar, "make_tables", build)
    assert rules(loaded()) == rules(first)


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
    assert loaded().reductions


def test_nobody_has_a_home(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def homeless() -> Path:
        raise RuntimeError("Could not determine home directory.")

    for variable in ("XDG_CACHE_HOME", "XDG_STATE_HOME"):
        monkeypatch.delenv(variable)
    monkeypatch.setattr(Path, "home", homeless)
    assert loaded().reductions
    assert not cache.exists()
