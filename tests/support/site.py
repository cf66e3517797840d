"""A built documentation site, as a browser reads its pages."""

from __future__ import annotations

import importlib
import sys
from dataclasses import dataclass, field
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

PROJECT = Path(__file__).parents[2]
PROGRAMS = PROJECT / "tools" / "website"


def program(name: str) -> Any:
    """A module of the programs that build the site."""
    if str(PROGRAMS) not in sys.path:
        sys.path.insert(0, str(PROGRAMS))  # before the package `build` of PyPI
    return importlib.import_module(name)


@dataclass
class Page:
    """The addresses on a page: those that it leads to, those that it loads, and its own anchors."""

    links: list[str] = field(default_factory=list)
    loads: list[str] = field(default_factory=list)
    anchors: set[str] = field(default_factory=set)
    classes: set[str] = field(default_factory=set)
    tags: list[str] = field(default_factory=list)


class _Reader(HTMLParser):
    def __init__(self, page: Page) -> None:
        super().__init__()
        self._page = page

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note the addresses of an element."""
        found = {name: value or "" for name, value in attrs}
        self._page.tags.append(tag)
        self._page.anchors.update(found[name] for name in ("id", "name") if name in found)
        self._page.classes.update(found.get("class", "").split())
        if tag == "a" and "href" in found:
            self._page.links.append(found["href"])
        elif tag == "link" and found.get("rel") not in {"canonical", "next", "prev"}:
            self._page.loads.append(found["href"])
        elif "src" in found:
            self._page.loads.append(found["src"])
        if "srcset" in found:
            self._page.loads += [each.split()[0] for each in found["srcset"].split(",")]


@cache
def read(path: Path) -> Page:
    """The addresses on a page."""
    page = Page()
    _Reader(page).feed(path.read_text(encoding="utf-8"))
    return page


def broken(path: Path, address: str) -> bool:
    """Say whether an address on a page leads to no file, or to no anchor of a page of the site.

    Addresses of other hosts are not looked at.
    """
    parts = urlsplit(address)
    if parts.scheme or parts.netloc:
        return False
    aim = (path.parent / unquote(parts.path)).resolve() if parts.path else path
    if not aim.is_file():
        return True
    anchor = unquote(parts.fragment)
    return bool(anchor) and aim.suffix == ".html" and anchor not in read(aim).anchors
