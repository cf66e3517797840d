"""Pages of numbered rules, each of which names the tests that pin it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]

_SECTION = re.compile(r"^## .*?(?=^## |\Z)", re.MULTILINE | re.DOTALL)
_FILE = re.compile(r"^Tests: `(tests/\S+\.py)`$", re.MULTILINE)


class RulePage:
    """A page in the documentation whose rules are called by a letter and a number."""

    def __init__(self, path: str, letter: str) -> None:
        self._text = (ROOT / path).read_text(encoding="utf-8")
        self._letter = letter
        self._rule = re.compile(
            rf"^\*\*{letter}(\d+)\. .*?(?=^\*\*{letter}|^#|\Z)", re.MULTILINE | re.DOTALL
        )

    def rules(self) -> dict[int, list[str]]:
        """The tests that each rule names, by its number, in the order of the page."""
        return self._rules_of(self._text)

    def misnamed(self) -> set[str]:
        """The tests that stand with a rule, but are called as if they were of another."""
        return {
            name
            for number, names in self.rules().items()
            for name in names
            if not name.startswith(f"test_{self._letter.lower()}{number}_")
        }

    def missing(self) -> set[str]:
        """The tests that rules name, but that are in no file that their section names."""
        found: set[str] = set()
        for section in self._sections():
            files = _FILE.findall(section)
            assert files, section.splitlines()[0]
            named = {name for names in self._rules_of(section).values() for name in names}
            found |= named - {name for file in files for name in self._defined_in(ROOT / file)}
        return found

    def named(self) -> list[str]:
        """The tests that all rules name, in alphabetical order."""
        return sorted(name for names in self.rules().values() for name in names)

    def defined(self, folder: Path) -> list[str]:
        """The tests in a folder, and in the files that sections name, that are called by a rule, in
        alphabetical order.
        """
        files = {*folder.glob("*.py"), *(ROOT / file for file in _FILE.findall(self._text))}
        return sorted(name for file in files for name in self._defined_in(file))

    def cited_in(self, *folders: str) -> set[int]:
        """The rules that the sources in some folders of the package name."""
        files = [file for each in folders for file in (ROOT / "src/rossmarie" / each).glob("*.py")]
        texts = [file.read_text(encoding="utf-8") for file in files]
        cite = re.compile(rf"\b{self._letter}(\d+)\b")
        return {int(number) for text in texts for number in cite.findall(text)}

    def _sections(self) -> Iterator[str]:
        """The sections of the page that have rules."""
        for section in _SECTION.findall(self._text):
            if self._rule.search(section):
                yield section

    def _rules_of(self, text: str) -> dict[int, list[str]]:
        return {
            int(rule[1]): re.findall(r"`(test_\w+)`", rule[0].partition("Tests:")[2])
            for rule in self._rule.finditer(text)
        }

    def _defined_in(self, file: Path) -> list[str]:
        text = file.read_text(encoding="utf-8")
        return re.findall(rf"^def (test_{self._letter.lower()}\d+_\w+)", text, re.MULTILINE)
