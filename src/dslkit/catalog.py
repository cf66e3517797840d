"""The diagnostics of a tool, and their pages: documentation, `explain` text, and test.

The page of `ROSS301` is `pages/ROSS301.md` in the package of the catalog.
"""

from __future__ import annotations

import difflib
from dataclasses import dataclass
from importlib.resources import files

from dslkit.diagnostics import Template
from dslkit.diagnostics.render_sarif import SarifRule, Tool


class UnknownCodeError(Exception):
    """No diagnostic has this code or name. The message suggests a similar one."""

    def __init__(self, asked: str, diagnostics: tuple[type[Template], ...]) -> None:
        message = f"there is no diagnostic `{asked}`"
        names = [spelling for found in diagnostics for spelling in (found.code, found.name)]
        upper, lower = asked.upper(), asked.lower()
        near = difflib.get_close_matches(upper, names) or difflib.get_close_matches(lower, names)
        if near:
            meant = " or ".join(f"`{name}`" for name in near)
            message += f"; did you mean {meant}?"
        super().__init__(message)


@dataclass(frozen=True)
class Catalog:
    """All diagnostics of a tool; `package` has the folder with their pages."""

    tool: str
    package: str
    diagnostics: tuple[type[Template], ...]

    def page(self, code: str) -> str:
        """The Markdown page of the diagnostic with this code or name, in upper or lower case.

        Raises `UnknownCodeError`.
        """
        asked = code.strip()
        for found in self.diagnostics:
            if asked.upper() == found.code or asked.lower() == found.name:
                return self._read(found)
        raise UnknownCodeError(asked, self.diagnostics)

    def sarif_tool(self, version: str) -> Tool:
        """The description of the tool in a SARIF log: its `version` and all its diagnostics."""
        rules = [
            SarifRule(
                found.code, found.name, found.severity, self._summary(found), self._read(found)
            )
            for found in self.diagnostics
        ]
        return Tool(self.tool, version, rules)

    def _read(self, found: type[Template]) -> str:
        page = files(self.package) / "pages" / f"{found.code}.md"
        return page.read_text(encoding="utf-8")

    def _summary(self, found: type[Template]) -> str:
        """The first paragraph under "What it means", a section of every page, in one line."""
        text = self._read(found).partition("## What it means\n")[2].strip()
        return " ".join(text.partition("\n\n")[0].split())
