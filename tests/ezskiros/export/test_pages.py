"""The pages of what is wrong with exports: their examples have it, the others have not."""

from __future__ import annotations

import hashlib
from pathlib import Path

import pytest

from dslkit.diagnostics import Diagnostic
from ezskiros.catalog import CATALOG
from ezskiros.export import Export, changed_sources, read_export
from ezskiros.export.sources import ExportedSource, digest_of
from support import command_line, expectations
from support.markdown import blocks


def write(code: str, heading: str, folder: Path) -> dict[str, str]:
    """Write the files of a page, and give their texts."""
    found = [each for each in blocks(CATALOG.page(code)) if each.heading == heading and each.name]
    for each in found:
        path = folder / str(each.name)
        path.parent.mkdir(exist_ok=True)
        path.write_text(each.text, encoding="utf-8")
    return {str(each.name): each.text for each in found}


@pytest.mark.parametrize("code", ["EZS863", "EZS864", "EZS865"])
@pytest.mark.parametrize("heading", ["Example", "Write instead"])
def test_the_example_has_the_finding(code: str, heading: str, tmp_path: Path) -> None:
    if not write(code, heading, tmp_path):
        return
    done = command_line.run("ezskiros", "export", "skill.py", "-o", "skills.json", folder=tmp_path)
    is_wrong = heading == "Example"
    assert (f"error[{code}]" in done.stdout) is is_wrong, done.stdout
    assert (tmp_path / "skills.json").exists() is not is_wrong


def test_the_example_of_an_older_format_is_refused(tmp_path: Path) -> None:
    text = write("EZS860", "Example", tmp_path)["skills.json"]
    (tmp_path / "skills.json").write_text(_without_marks(text))
    found = read_export(tmp_path / "skills.json")
    assert isinstance(found, Diagnostic)
    assert expectations.compare(text, [found], "#") == []


def test_the_example_of_a_stale_export_is_found_out(tmp_path: Path) -> None:
    text = write("EZS861", "Example", tmp_path)["skills.json"]
    old = hashlib.sha256(b"old").hexdigest()
    (tmp_path / "push.py").write_text("new")
    digest = digest_of([ExportedSource("push.py", old)])
    right = _without_marks(text).replace("DIGEST", digest).replace("SHA256", old)
    (tmp_path / "skills.json").write_text(right)
    export = read_export(tmp_path / "skills.json")
    assert isinstance(export, Export)
    assert expectations.compare(text, list(changed_sources(export)), "#") == []


def _without_marks(text: str) -> str:
    return "".join(each for each in text.splitlines(True) if not each.startswith("#"))
