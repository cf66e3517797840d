"""Files are written as a whole, or stay as they are."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from dslkit.writing import try_folder, try_writing, write_whole


def test_a_file_is_written(tmp_path: Path) -> None:
    write_whole(tmp_path / "new", "a\r\nü\n")
    assert (tmp_path / "new").read_bytes() == "a\r\nü\n".encode()
    assert [path.name for path in tmp_path.iterdir()] == ["new"]


def test_a_full_disk_leaves_the_file_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    path = tmp_path / "rules.ross"
    path.write_text("old")
    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        write_whole(path, "new")
    assert path.read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["rules.ross"]


def test_permissions_and_links_stay(tmp_path: Path) -> None:
    path = tmp_path / "rules.ross"
    path.write_text("old")
    path.chmod(0o640)
    link = tmp_path / "link.ross"
    link.symlink_to(path)
    write_whole(link, "new")
    assert link.is_symlink()
    assert path.read_text() == "new"
    assert path.stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize("place", ["new", "there", "there/deep/below"])
def test_trying_leaves_all_as_it_is(tmp_path: Path, place: str) -> None:
    (tmp_path / "there").mkdir()
    try_folder(tmp_path / place)
    assert [path.name for path in tmp_path.rglob("*")] == ["there"]
    (tmp_path / "old").write_text("old")
    try_writing(tmp_path / "old")
    assert (tmp_path / "old").read_text() == "old"
    assert len(list(tmp_path.iterdir())) == 2


def test_a_file_name_that_is_no_text_is_written_with_its_numbers(tmp_path: Path) -> None:
    write_whole(tmp_path / "new", "of \udcff.ross")
    assert (tmp_path / "new").read_text() == r"of \udcff.ross"
