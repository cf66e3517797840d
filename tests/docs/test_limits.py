"""The page of limits has the numbers that hold."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.export import read, trees
from ezskiros.learning import records
from ezskiros.ontology import limits as ontologies
from ezskiros.trees import launch
from rossmarie.driver import package_xml
from rossmarie.recordings import limits as recordings

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "limits.md"
MIB = 1 << 20


def row(what: str) -> str:
    """The limit in the row of a table that begins so."""
    lines = [line for line in PAGE.read_text(encoding="utf-8").splitlines() if "|" in line]
    (found,) = (line for line in lines if line.startswith((f"| {what} |", f"| {what} ([")))
    return found.split(" | ")[1]


def mib(size: int) -> str:
    return f"{size // MIB} MiB"


def number(count: int) -> str:
    return f"{count:,}".replace(",", " ")


@pytest.mark.parametrize(
    ("what", "limit"),
    [
        ("Decompressed bytes, for any ratio", mib(recordings.SMALL_CHUNK)),
        (
            "Decompressed bytes for each compressed byte, above that size",
            number(recordings.HIGHEST_RATIO),
        ),
        ("Decompressed bytes of a chunk, in any case", mib(recordings.LARGEST_CHUNK)),
        (
            "Decompressed bytes of a recording, "
            f"beyond {recordings.HIGHEST_RATIO} for each byte of the file",
            mib(recordings.SMALL_RECORDING),
        ),
        (
            "Messages of a recording without an index, "
            f"beyond one message for each {recordings.BYTES_OF_A_MESSAGE} bytes of the file",
            number(recordings.MOST_MESSAGES),
        ),
        ("Strings and messages in the arrays of one message", number(recordings.MOST_ELEMENTS)),
        (
            "Elements of an array of fixed length, unless they are numbers",
            number(recordings.LONGEST_FIXED_ARRAY),
        ),
        ("Nesting of message types", number(recordings.DEEPEST_TYPE)),
        (
            "Fields of a message type, including the fields of its parts",
            number(recordings.MOST_FIELDS),
        ),
        (
            "Metadata in YAML (`metadata.yaml`, quality of service)",
            mib(recordings.LARGEST_METADATA),
        ),
        ("Line of a CSV file", mib(recordings.LONGEST_LINE)),
        (
            "`package.xml` of a package",
            f"{package_xml.LARGEST_FILE >> 10} KiB",
        ),
        ("Nesting of elements in a `package.xml`", number(package_xml.DEEPEST)),
        ("Skills file", mib(read.LARGEST_EXPORT)),
        ("Record of a run, or knowledge of runs", mib(records.LARGEST_RECORD)),
        ("Levels of a behavior tree in a skills file", number(trees.MOST_LEVELS)),
        (
            "Values that are known at launch",
            f"{launch.LARGEST_FILE >> 10} KiB",
        ),
        ("Size of a file", mib(ontologies.LARGEST_FILE)),
        (
            "Nesting of elements, objects, lists or triple terms",
            number(ontologies.DEEPEST),
        ),
        ("Namespaces in scope at one XML element", number(ontologies.MOST_NAMESPACES)),
        ("Triples of a file", number(ontologies.MOST_TRIPLES)),
        ("Text of a file with entities and prefixes expanded", mib(ontologies.LONGEST_TEXT)),
    ],
)
def test_the_page_has_the_limit(what: str, limit: str) -> None:
    assert row(what) == limit
