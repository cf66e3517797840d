"""The documentation site: it builds, its links lead somewhere, and it needs no other host."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from rossmarie.highlighting import keywords
from support.browser import document_of, needs_browser, printed_sheets
from support.parts import SITE, needs
from support.site import PROGRAMS, PROJECT, broken, program, read

pytestmark = needs(SITE)


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the site as `make site` builds it, with a strict generator."""
    out = tmp_path_factory.mktemp("site")
    done = subprocess.run(
        [sys.executable, PROGRAMS / "build_site.py", "--out", out],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert str(out / "index.html") in done.stdout
    (folder,) = out.glob("*/index.html")
    return folder.parent


def pages(built: Path) -> Iterator[Path]:
    # The page for addresses that do not exist has addresses from the top of a server.
    return (path for path in sorted(built.rglob("*.html")) if path.name != "404.html")


def test_each_page_of_the_project_is_in_the_site(built: Path) -> None:
    found = {str(path.relative_to(built)) for path in pages(built)}
    for path in (PROJECT / "docs").rglob("*.md"):
        if path.name != "README.md":
            assert str(path.relative_to(PROJECT / "docs").with_suffix(".html")) in found
    for path in PROJECT.glob("src/*/catalog/pages/*.md"):
        assert f"diagnostics/{path.stem}.html" in found
    assert "../reference/ezskiros-diagnostics.html" in read(built / "diagnostics/EZS401.html").links
    assert {"index.html", "contents.html", "project/architecture.html"} <= found


def test_each_link_and_anchor_inside_the_site_leads_somewhere(built: Path) -> None:
    wrong = [
        f"{path.relative_to(built)}: {address}"
        for path in pages(built)
        for address in {*read(path).links, *read(path).loads}
        if broken(path, address)
    ]
    assert wrong == []


def test_a_link_to_no_page_and_one_to_no_anchor_are_found(built: Path) -> None:
    index = built / "index.html"
    assert not broken(index, "reference/language.html#for")
    assert broken(index, "reference/language.html#fore")
    assert broken(index, "reference/no-language.html")
    assert broken(index, "#fore")


def test_no_page_loads_anything_from_another_host(built: Path) -> None:
    loaded = {address for path in pages(built) for address in read(path).loads}
    assert [address for address in loaded if re.match(r"(https?:)?//", address)] == []
    for style in built.rglob("*.css"):
        text = style.read_text(encoding="utf-8")
        assert re.findall(r"(?:url\(|@import)\s*[\"']?(?:https?:)?//[^)\"']*", text) == []


def test_no_page_has_a_diagram_whose_program_the_theme_would_fetch(built: Path) -> None:
    assert [path.name for path in pages(built) if "mermaid" in read(path).classes] == []


def test_the_search_index_has_each_construct_and_each_code(built: Path) -> None:
    entries = json.loads((built / "search" / "search_index.json").read_text("utf-8"))["docs"]
    sheet = " ".join(
        each["text"] for each in entries if "reference/cheat-sheet" in each["location"]
    )
    assert [word for word in keywords() if not re.search(rf"\b{word}\b", sheet)] == []
    titles = {each["title"].split()[0] for each in entries if each["title"]}
    codes = {path.stem for path in PROJECT.glob("src/*/catalog/pages/*.md")}
    assert codes - titles == set()


def test_rules_and_commands_are_coloured(built: Path) -> None:
    text = (built / "tutorial" / "first-rules.html").read_text(encoding="utf-8")
    assert '<span class="kd">rule</span>' in text
    assert '<span class="gp">$ </span>' in text
    assert '<span class="filename">' in text
    assert "err" not in read(built / "reference" / "language.html").classes


def test_lists_in_lists_and_tables_are_those_of_the_pages(built: Path) -> None:
    contents = (built / "contents.html").read_text(encoding="utf-8")
    assert re.search(r"<strong>How-to</strong>\s*<ul>\s*<li>", contents)
    assert "table" in read(built / "reference" / "language.html").tags
    assert "| --- |" not in (built / "reference" / "language.html").read_text(encoding="utf-8")


def test_the_first_page_leads_to_the_newest_version(built: Path) -> None:
    out = built.parent
    offered = [each["version"] for each in json.loads((out / "versions.json").read_text("utf-8"))]
    assert offered == [program("build_site").version_of(PROJECT)]
    assert read(out / "index.html").links == [f"{offered[0]}/index.html"]
    assert not broken(out / "index.html", f"{offered[0]}/index.html")


def test_versions_stand_newest_first(tmp_path: Path) -> None:
    for name in ("0.9", "0.10", "1.0", ".work", "images"):
        (tmp_path / name).mkdir()
    assert program("build_site").versions_in(tmp_path) == ["1.0", "0.10", "0.9"]


def test_a_link_to_no_anchor_ends_the_build(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    project = tmp_path / "project"
    for name in ("README.md", "ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md"):
        (project / "docs" / "decisions").mkdir(parents=True, exist_ok=True)
        (project / name).write_text("# One\n", encoding="utf-8")
    for name in ("gallery.md", "experiments.md", "learning.md", "decisions/index.md"):
        (project / "docs" / name).write_text("# One\n", encoding="utf-8")
    (project / "docs" / "README.md").write_text("[a](gallery.md#two)\n", encoding="utf-8")
    (project / "pyproject.toml").write_text('version = "2.3.4"\n', encoding="utf-8")
    build = program("build_site")
    monkeypatch.setattr(build, "PROJECT", project)
    with pytest.raises(SystemExit, match="does not contain an anchor '#two'"):
        build.build(tmp_path / "out")
    (project / "docs" / "README.md").write_text("[a](gallery.md#one)\n", encoding="utf-8")
    assert build.build(tmp_path / "out").is_file()
    assert build.versions_in(tmp_path / "out") == ["2.3"]


@needs_browser
@pytest.mark.parametrize("name", ["cheat-sheet", "ezskiros-cheat-sheet"])
def test_a_cheat_sheet_prints_on_two_sheets(built: Path, name: str) -> None:
    assert printed_sheets(built / "reference" / f"{name}.html") <= 2


@needs_browser
def test_the_search_works_from_a_disk_without_a_network(built: Path) -> None:
    document = document_of(built / "reference" / "cheat-sheet.html", "?q=retrace")
    assert re.search(r"\d+ matching documents", document)
    assert "<mark data-md-highlight>retrace" in document or "retrace</mark>" in document
