"""The glossary: its form, and the words that users must not meet."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
import typer

import crosscheck.cli.main
import ezskiros.cli.main
import heron.cli.main
import rossmarie.cli.main

PROJECT = Path(__file__).parents[2]
GLOSSARY = PROJECT / "docs" / "reference" / "glossary.md"
APPS = {
    "rossmarie": rossmarie.cli.main.app,
    "ezskiros": ezskiros.cli.main.app,
    "crosscheck": crosscheck.cli.main.app,
    "heron": heron.cli.main.app,
}
QUOTED = re.compile(r'"([^"]+)"')


@dataclass(frozen=True)
class Entry:
    """One row of a table of the glossary."""

    field: str
    word: str
    definition: str
    place: str
    avoided: str


def entries() -> list[Entry]:
    """The rows of all tables, in the order of the page."""
    found: list[Entry] = []
    field = ""
    for line in GLOSSARY.read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            field = line[3:]
        elif line.startswith("| ") and not line.startswith(("| Word |", "| --- |")):
            cells = [each.strip() for each in line.strip().strip("|").split(" | ")]
            word, definition, place, avoided = (each.strip("| ") for each in cells)
            found.append(Entry(field, word, definition, place, avoided))
    return found


def helps(name: str, command: Any) -> Iterator[tuple[str, str]]:
    """The texts that `--help` prints for a command and for the commands below it."""
    yield f"{name} --help", command.help or ""
    for each in command.params:
        yield f"{name} --help", getattr(each, "help", None) or ""
    for below, each in getattr(command, "commands", {}).items():
        yield from helps(f"{name} {below}", each)


def texts() -> Iterator[tuple[str, str]]:
    """All lines that users read in pages and in `--help`, each with its place."""
    for pattern in ("README.md", "docs/**/*.md", "src/*/catalog/pages/*.md"):
        for path in sorted(PROJECT.glob(pattern)):
            if path == GLOSSARY:
                continue
            lines = path.read_text(encoding="utf-8").splitlines()
            for number, line in enumerate(lines, start=1):
                yield f"{path.relative_to(PROJECT)}:{number}", line
    for name, app in APPS.items():
        yield from helps(name, typer.main.get_command(app))


def test_each_entry_has_one_sentence_and_a_place() -> None:
    found = entries()
    assert found
    for each in found:
        assert each.definition.endswith("."), each.word
        assert ". " not in each.definition, each.word
        assert each.word.split()[0].lower().removesuffix("e") in each.definition.lower(), each.word
        assert each.place, each.word


def test_each_word_is_defined_once_and_in_the_order_of_the_alphabet() -> None:
    found = entries()
    words = [each.word for each in found]
    assert sorted(set(words)) == sorted(words)
    for field in {each.field for each in found}:
        inside = [each.word.casefold() for each in found if each.field == field]
        assert inside == sorted(inside), field


def test_no_word_is_avoided_and_defined() -> None:
    avoided = {word for each in entries() for word in QUOTED.findall(each.avoided)}
    assert avoided
    assert avoided.isdisjoint(each.word for each in entries())


@pytest.mark.parametrize("word", sorted({w for e in entries() for w in QUOTED.findall(e.avoided)}))
def test_users_do_not_meet_avoided_words(word: str) -> None:
    wrong = re.compile(rf"(?<!\w){re.escape(word)}(?!\w)", re.IGNORECASE)
    assert [f"{place}: {line}" for place, line in texts() if wrong.search(line)] == []


def test_the_texts_include_pages_and_help() -> None:
    places = {place.partition(":")[0] for place, _ in texts()}
    assert {"README.md", "docs/README.md", "src/rossmarie/catalog/pages/ROSS001.md"} <= places
    assert {"rossmarie check --help", "heron run nav --help", "ezskiros run --help"} <= places


def test_other_pages_lead_to_the_glossary() -> None:
    contents = (PROJECT / "docs" / "README.md").read_text(encoding="utf-8")
    assert "(reference/glossary.md)" in contents
