"""Collect the pages of the site from their places in the project.

Pages of `docs` keep their paths. The pages of the diagnostics, the pages at the top of the project,
and each file that a page links to get a path in the site, so that a reader needs no other host.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from dialect import title, to_site

TOP = {
    "README.md": "index.md",
    "docs/README.md": "contents.md",
    "ARCHITECTURE.md": "project/architecture.md",
    "CHANGELOG.md": "project/changelog.md",
    "CONTRIBUTING.md": "project/contributing.md",
}
"""Pages with another name in the site."""
SETTINGS = {
    "README.md": "hide:\n  - navigation\n",
    "docs/reference/cheat-sheet.md": "hide:\n  - navigation\n  - toc\nsearch:\n  boost: 2\n",
    "docs/reference/ezskiros-cheat-sheet.md": "hide:\n  - navigation\n  - toc\n",
    "docs/reference/language.md": "search:\n  boost: 4\n",
}
"""Settings of single pages: hidden menus, and the rank in a search."""
CODES = re.compile(r"src/(\w+)/catalog/pages/(\w+\.md)")
TABLES = {
    "crosscheck": "docs/reference/crosscheck.md",
    "ezskiros": "docs/reference/ezskiros-diagnostics.md",
    "rossmarie": "docs/reference/diagnostics.md",
}
"""The page with all diagnostics of a program."""
IMAGES = frozenset({".csv", ".gif", ".jpg", ".png", ".svg", ".webp"})
LANGUAGES = {".py": "python", ".ross": "ross", ".sh": "bash", ".toml": "toml", ".ttl": "turtle"}
FENCE = "`" * 6


class Pages:
    """The pages of a project, and the folder for the converted pages."""

    def __init__(self, project: Path, folder: Path) -> None:
        self._project = project.resolve()
        self._folder = folder
        self._open: list[str] = []
        self._known: set[str] = set()
        self.titles: dict[str, str] = {}
        """The title of each page by its path in the site."""

    def write(self) -> None:
        """Write each page, and each file that a page links to."""
        if self._folder.exists():
            shutil.rmtree(self._folder)
        for page in self._first():
            self._want(page)
        while self._open:
            self._write(self._open.pop(0))

    def _first(self) -> Iterator[str]:
        """The pages that the site always contains."""
        yield from TOP
        for pattern in ("docs/**/*.md", "src/*/catalog/pages/*.md"):
            for path in sorted(self._project.glob(pattern)):
                yield path.relative_to(self._project).as_posix()

    def _want(self, source: str) -> None:
        if source not in self._known:
            self._known.add(source)
            self._open.append(source)

    def place(self, source: str) -> str:
        """The path in the site of a file or folder of the project."""
        if source in TOP:
            return TOP[source]
        if code := CODES.fullmatch(source):
            return f"diagnostics/{code[2]}"
        inside = source.removeprefix("docs/") if source.startswith("docs/") else f"files/{source}"
        if (self._project / source).is_dir():
            return f"{inside}/index.md"
        if PurePosixPath(source).suffix in {".md", *IMAGES}:
            return inside
        return f"{inside}.md"

    def _write(self, source: str) -> None:
        path, place = self._project / source, self.place(source)
        written = self._folder / place
        written.parent.mkdir(parents=True, exist_ok=True)
        if path.suffix in IMAGES:
            shutil.copyfile(path, written)
            return
        if path.is_dir():
            text = self._listing(source)
        elif path.suffix == ".md":
            text = path.read_text(encoding="utf-8")
            if code := CODES.fullmatch(source):
                text += f"\n[All diagnostics of `{code[1]}`](../../../../{TABLES[code[1]]})\n"
        else:
            code = path.read_text(encoding="utf-8").rstrip("\n")
            text = f"# {source}\n\n{FENCE}{LANGUAGES.get(path.suffix, 'text')}\n{code}\n{FENCE}\n"
            written.write_text(text, encoding="utf-8")
            self.titles[place] = title(text)
            return
        self.titles[place] = title(text)
        settings = f"---\n{SETTINGS[source]}---\n\n" if source in SETTINGS else ""
        text = to_site(text, lambda target: self._target(source, target))
        written.write_text(settings + text, encoding="utf-8")

    def _listing(self, source: str) -> str:
        """A page that lists the pages and files of a folder."""
        name = "Decisions" if source == "docs/decisions" else source
        lines = [f"# {name}", ""]
        for path in sorted((self._project / source).iterdir()):
            if path.is_file():
                text = path.read_text(encoding="utf-8") if path.suffix == ".md" else ""
                lines.append(f"- [{title(text) or path.name}]({path.name})")
        return "\n".join([*lines, ""])

    def _target(self, source: str, target: str) -> str:
        """The address in the site for an address on a page of the project."""
        address, sign, anchor = target.partition("#")
        if not address or "://" in address or address.startswith(("mailto:", "data:")):
            return target
        base = self._project / source
        path = Path(os.path.normpath((base if base.is_dir() else base.parent) / address))
        if not path.exists() or not path.is_relative_to(self._project):
            return target
        wanted = path.relative_to(self._project).as_posix()
        self._want(wanted)
        here = PurePosixPath(self.place(source)).parent
        found = os.path.relpath(self.place(wanted), here)
        return f"{found}{sign}{anchor}" if path.suffix == ".md" else found


def navigation(pages: Pages, contents: str) -> list[object]:
    """The sections of the site. The page of contents gives the order of the pages."""
    order = re.findall(r"\]\(([\w/-]+\.md)\)", contents)
    decisions = _in(pages, "decisions/", order)
    reference = _in(pages, "reference/", order)
    measured = [page for page in reference if "/performance" in page or "-reuse" in page]
    return [
        {"Home": "index.md"},
        {"Tutorials": _in(pages, "tutorial/", order)},
        {"How-to guides": _in(pages, "how-to/", order)},
        {"Explanation": _in(pages, "explanation/", order)},
        {
            "Reference": [
                *(page for page in reference if page not in measured),
                {"Measurements": measured},
            ]
        },
        {"Gallery and results": ["gallery.md", "experiments.md", "learning.md"]},
        {"Decisions": ["decisions/index.md", *(p for p in decisions if "index" not in p)]},
        {"Project": ["contents.md", *_in(pages, "project/", order)]},
    ]


def _in(pages: Pages, folder: str, order: list[str]) -> list[str]:
    """The pages of a folder: first the pages of the order, then the other pages by name."""
    found = sorted(page for page in pages.titles if page.startswith(folder))
    return sorted(found, key=lambda page: order.index(page) if page in order else len(order))
