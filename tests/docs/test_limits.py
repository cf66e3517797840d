"""The page of limits has the numbers that hold."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.ontology import limits as ontologies

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "limits.md"
MIB = 1 << 20


def row(what: str) -> str:
    """The limit in the row of a table that begins so."""
    lines = [line for line in PAGE.read_text(encoding="utf-8").splitlines() if "|" in line]
    (found,) = (line for line in lines if line.startswith(f"| {what} |"))
    return found.split(" | ")[1]


def mib(size: int) -> str:
    return f"{size // MIB} MiB"


def number(count: int) -> str:
    return f"{count:,}".replace(",", " ")


@pytest.mark.parametrize(
    ("what", "limit"),
    [
        ("Size of a file", mib(ontologies.LARGEST_FILE)),
        (
            "Elements, objects, lists or triple terms in each other",
            number(ontologies.DEEPEST),
        ),
        ("Namespaces in force at one XML element", number(ontologies.MOST_NAMESPACES)),
        ("Triples of a file", number(ontologies.MOST_TRIPLES)),
        ("Text of a file with entities and prefixes in full", mib(ontologies.LONGEST_TEXT)),
    ],
)
def test_the_page_has_the_limit(what: str, limit: str) -> None:
    assert row(what) == limit
