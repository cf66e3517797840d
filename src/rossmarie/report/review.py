"""Rules beside the C that was generated from them: one HTML page, for the review of generated code.

The input is the rules files and the generated files. A comment on a generated line names its line
of the rules. The page uses only these comments, so that it shows no more than a reviewer could
find.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import PurePath

from markupsafe import Markup

from dslkit.source import SourceFile
from rossmarie.report.templates import asset, template


@dataclass(frozen=True)
class Made:
    """Generated lines that belong together: their place, and their text without the comment about
    the line of the rules.
    """

    file: str
    line: int
    text: str


@dataclass(frozen=True)
class Row:
    """A line of rules, and the lines generated from it."""

    line: int
    text: str
    made: tuple[Made, ...]


def render_review(sources: Iterable[SourceFile], generated: Mapping[str, str]) -> str:
    """The text of the page. `generated` are the C files of the rules themselves, by their names."""
    pairs = [(PurePath(each.path).name, side_by_side(each, generated)) for each in sources]
    tables = [(name, rows) for name, rows in pairs if any(row.made for row in rows)]
    return template("review.html.j2").render(
        tables=tables,
        files=[(name, text.count("\n")) for name, text in generated.items()],
        style=Markup(asset("palette.css") + asset("review.css")),
    )


def side_by_side(source: SourceFile, generated: Mapping[str, str]) -> Sequence[Row]:
    """The lines of a rules file, each with the lines generated from it."""
    made: dict[int, list[Made]] = {}
    for file, text in generated.items():
        for place, found in _marked(PurePath(source.path).name, text):
            made.setdefault(place, []).append(Made(file, *found))
    return [
        Row(number, line, tuple(made.get(number, ())))
        for number, line in enumerate(source.text.splitlines(), start=1)
    ]


def _marked(name: str, text: str) -> Iterator[tuple[int, tuple[int, str]]]:
    """The lines that name a line of a rules file, with the line that they name."""
    mark = re.compile(rf"\s*/\* {re.escape(name)}:(\d+)\b.*?\*/")
    for number, line in enumerate(text.splitlines(), start=1):
        if found := mark.search(line):
            own = f"{line[: found.start()]}{line[found.end() :]}".strip()
            yield int(found[1]), (number, own)
