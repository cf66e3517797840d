"""The page of a diagnostic: its documentation, its `explain` text, and (its examples) its test."""

from __future__ import annotations

import difflib
from importlib.resources import files

from dslkit.diagnostics import Template
from dslkit.diagnostics.render_sarif import Rule, Tool
from rossmarie.catalog.index import DIAGNOSTICS


class UnknownCodeError(Exception):
    """There is no diagnostic of that code or name; the message says which one may be meant."""

    def __init__(self, asked: str) -> None:
        message = f"there is no diagnostic `{asked}`"
        names = [spelling for found in DIAGNOSTICS for spelling in (found.code, found.name)]
        upper, lower = asked.upper(), asked.lower()
        near = difflib.get_close_matches(upper, names) or difflib.get_close_matches(lower, names)
        if near:
            meant = " or ".join(f"`{name}`" for name in near)
            message += f"; did you mean {meant}?"
        super().__init__(message)


def page(code: str) -> str:
    """The page, in Markdown, of the diagnostic with this code or name, in whatever case.

    Raises `UnknownCodeError`.
    """
    asked = code.strip()
    for found in DIAGNOSTICS:
        if asked.upper() == found.code or asked.lower() == found.name:
            return _read(found)
    raise UnknownCodeError(asked)


def sarif_rules(version: str) -> Tool:
    """What a SARIF log says about the tool: its `version` and all its diagnostics."""
    rules = [
        Rule(found.code, found.name, found.severity, _summary(found), _read(found))
        for found in DIAGNOSTICS
    ]
    return Tool("rossmarie", version, rules)


def _read(found: type[Template]) -> str:
    page = files("rossmarie.catalog") / "pages" / f"{found.code}.md"
    return page.read_text(encoding="utf-8")


def _summary(found: type[Template]) -> str:
    """The first paragraph under "What it means", which stands on every page, in one line."""
    text = _read(found).partition("## What it means\n")[2].strip()
    return " ".join(text.partition("\n\n")[0].split())
