"""An export that is read again: hostile ones are refused, and stale ones are found out."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dslkit.diagnostics import Diagnostic
from dslkit.diagnostics.render_text import render_text
from ezskiros.export import Export, changed_sources, not_exported, read_export
from ezskiros.export.read import LARGEST_EXPORT
from ezskiros.export.sources import FORMAT, VERSION, ExportedSource, digest_of, sources_of


def written(folder: Path, *files: Path) -> Path:
    """An export of some files."""
    sources = sources_of(files, folder)
    head = {"format": FORMAT, "version": VERSION, "digest": digest_of(sources)}
    path = folder / "skills.json"
    path.write_text(json.dumps({**head, "sources": [vars(each) for each in sources]}))
    return path


def right(path: Path) -> Export:
    found = read_export(path)
    assert isinstance(found, Export)
    return found


def test_it_is_stale_when_a_source_changes_or_goes(tmp_path: Path) -> None:
    files = [tmp_path / "a.py", tmp_path / "b c" / "\u00e9.ttl"]
    for each in files:
        each.parent.mkdir(exist_ok=True)
        each.write_text("as it was")
    export = right(written(tmp_path, *files))
    assert list(changed_sources(export)) == []
    files[0].write_text("as it is")
    files[1].unlink()
    os.mkfifo(files[1])
    reported = [(each.primary.span.text, each.title) for each in changed_sources(export)]
    assert reported == [
        ('"a.py"', f"`{export.file.path}` is stale: `a.py` has changed"),
        (
            json.dumps("b c/\u00e9.ttl"),
            f"`{export.file.path}` is stale: `b c/\u00e9.ttl` no longer exists",
        ),
    ]


def test_what_it_was_not_made_of_is_reported(tmp_path: Path) -> None:
    for name in ("a.py", "b.py"):
        (tmp_path / name).touch()
    export = right(written(tmp_path, tmp_path / "a.py"))
    assert list(not_exported(export, [tmp_path / "a.py"])) == []
    (found,) = not_exported(export, [tmp_path / "a.py", tmp_path / "b.py"])
    assert (found.code, "`b.py`" in found.title) == ("EZS862", True)


def test_a_linked_folder_is_the_same_folder(tmp_path: Path) -> None:
    folder, link = tmp_path / "deep" / "one", tmp_path / "link"
    folder.mkdir(parents=True)
    (tmp_path / "deep" / "a.py").touch()
    link.symlink_to(folder)
    written(link, tmp_path / "deep" / "a.py")
    export = right(link / "skills.json")
    assert [each.path for each in export.sources] == ["../a.py"]
    assert list(changed_sources(export)) == []


HEAD = {"format": FORMAT, "version": VERSION}
NO_SOURCES = {**HEAD, "sources": [], "digest": digest_of([])}


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "it is not JSON"),
        ('{"format": }', "it is not JSON"),
        ("[" * 100_000, ""),
        ("3", "its `format`"),
        ("{}", "its `format`"),
        (json.dumps({**NO_SOURCES, "format": "rossmarie/rules"}), "its `format`"),
        (json.dumps({**NO_SOURCES, "version": 2}), "its `version`"),
        (json.dumps({**NO_SOURCES, "version": True}), "its `version`"),
        (json.dumps({**NO_SOURCES, "digest": "0" * 64}), "its `digest`"),
        (json.dumps({**NO_SOURCES, "sources": {}}), "its `sources`"),
        (json.dumps({**NO_SOURCES, "sources": [3]}), "its `sources`"),
        (json.dumps({**NO_SOURCES, "sources": [{"path": "a"}]}), "its `sources`"),
        (
            json.dumps({**NO_SOURCES, "sources": [{"path": "/a", "sha256": "0" * 64}]}),
            "its `sources`",
        ),
        (
            json.dumps({**NO_SOURCES, "sources": [{"path": "a", "sha256": "0" * 63 + "\n"}]}),
            "its `sources`",
        ),
        ('{"format": NaN}', "`NaN` is not a JSON number"),
        ("1" * 10_000, ""),
    ],
)
def test_what_is_no_export_is_refused_at_its_place(text: str, reason: str, tmp_path: Path) -> None:
    path = tmp_path / "skills.json"
    path.write_text(text)
    found = read_export(path)
    assert isinstance(found, Diagnostic)
    assert found.code == "EZS860"
    assert (found.primary.text or "").startswith(reason)


def test_a_file_that_is_too_large_is_not_read_to_its_end(tmp_path: Path) -> None:
    path = tmp_path / "skills.json"
    with path.open("wb") as file:
        file.truncate(LARGEST_EXPORT + 1)
    found = read_export(path)
    assert isinstance(found, Diagnostic)
    assert found.primary.text == "it is larger than 64 MiB"


def test_bytes_that_are_no_text_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "skills.json"
    path.write_bytes(b'{"format": "\xff"}')
    found = read_export(path)
    assert isinstance(found, Diagnostic)
    assert found.primary.text == "byte 13 is not UTF-8"


def test_a_path_that_none_can_be_is_stale(tmp_path: Path) -> None:
    names = ["\0", "a" * 5000, "\ud800", ".", "a\nb"]
    sources = [ExportedSource(name, "0" * 64) for name in names]
    head = {**HEAD, "digest": digest_of(sources), "sources": [vars(each) for each in sources]}
    path = tmp_path / "skills.json"
    path.write_text(json.dumps(head))
    found = list(changed_sources(right(path)))
    assert len(found) == len(names)
    assert render_text(found).plain.encode()


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inside: st.lists(inside) | st.dictionaries(st.text(), inside),
)


@given(st.dictionaries(st.sampled_from(["format", "version", "digest", "sources"]), json_values))
def test_no_head_makes_it_raise(tmp_path_factory: pytest.TempPathFactory, head: object) -> None:
    path = tmp_path_factory.getbasetemp() / "any.json"
    path.write_text(json.dumps({**NO_SOURCES, **head}))  # type: ignore[dict-item]
    found = read_export(path)
    assert isinstance(found, Diagnostic) or found.digest == digest_of([])
