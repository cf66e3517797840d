"""Source lines with marks under them, as they stand between the title of a finding and its notes.

In go labels (spans with a text); out come rows of a terminal, as text with styles. Any span of any
text can be drawn: tabs, wide and combining characters, control characters, lines of any length,
spans over several lines, empty spans and the end of the file.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from rich.text import Text

from dslkit.diagnostics.model import Label
from dslkit.diagnostics.visible import cells, columns_of, visible
from dslkit.source import SourceFile

GUTTER_STYLE = "bold blue"
_ELISION = "…"


@dataclass(frozen=True)
class Mark:
    """A stretch `[start, end)` of the characters of one line, drawn as `symbol`s."""

    line: int
    start: int
    end: int
    symbol: str
    style: str
    text: str = ""


@dataclass(frozen=True)
class Gutter:
    """The column of line numbers, `width` digits wide."""

    width: int

    def row(self, content: Text | str = "", line: int | None = None) -> Text:
        """A row; with the number of a line if it shows one."""
        number = "" if line is None else str(line)
        row = Text(f"{number:>{self.width}} |", style=GUTTER_STYLE)
        if content:
            row.append(" ")
            row.append_text(Text(content) if isinstance(content, str) else content)
        return row

    def gap(self) -> Text:
        """The row that stands for lines left out."""
        return Text("...", style=GUTTER_STYLE)

    def attached(self, kind: str, text: str) -> Iterator[Text]:
        """A remark under a snippet: `= note: ...`, further lines indented below it."""
        first, *rest = text.split("\n")
        lead = " " * (self.width + 1)
        row = Text(lead).append("= ", GUTTER_STYLE).append(f"{kind}: ", "bold")
        yield row.append(visible(first))
        for line in rest:
            yield Text(f"{lead}{' ' * len(f'= {kind}: ')}{visible(line)}")


def marks_of(label: Label, symbol: str, style: str) -> Iterator[Mark]:
    """The marks of a label: one, or for a span over several lines one at each of its ends."""
    span = label.span
    file = span.file
    ends_line = span.end > span.start and file.text[span.end - 1] == "\n"
    begin, finish = span.begin, file.position(span.end - 1 if ends_line else span.end)
    text = visible(label.text)
    start, end = begin.column - 1, finish.column - 1
    first = max(len(file.line_text(begin.line)), start)
    if begin.line == finish.line:
        yield Mark(begin.line, start, min(end, first), symbol, style, text)
        return
    yield Mark(begin.line, start, first, symbol, style)
    last = file.line_text(finish.line)
    indent = len(last) - len(last.lstrip())
    yield Mark(finish.line, min(indent, max(end - 1, 0)), max(end, 1), symbol, style, text)


def draw(file: SourceFile, marks: Iterable[Mark], gutter: Gutter, width: int) -> Iterator[Text]:
    """The marked lines of a file in order, each with its marks below it in the order given."""
    by_line: dict[int, list[Mark]] = {}
    for mark in marks:
        by_line.setdefault(mark.line, []).append(mark)
    previous = None
    for line in sorted(by_line):
        if previous is not None and line > previous + 1:
            yield gutter.gap()
        previous = line
        yield from _draw_line(file.line_text(line), by_line[line], gutter, width)


def _draw_line(text: str, marks: Sequence[Mark], gutter: Gutter, width: int) -> Iterator[Text]:
    shown = _ShownLine(text)
    for together in _fitting_together(shown, marks, width):
        window = shown.window(together, width)
        yield gutter.row(shown.clip(window), together[0].line)
        for mark in together:
            yield gutter.row(shown.underline(mark, window))


def _fitting_together(
    shown: _ShownLine, marks: Sequence[Mark], width: int
) -> Iterator[Sequence[Mark]]:
    """All marks at once if one stretch of the line can show where all begin, else one by one."""
    columns = [shown.column(mark.start) for mark in marks]
    if shown.width <= width or max(columns) - min(columns) < width // 2:
        yield marks
    else:
        yield from ([mark] for mark in marks)


class _ShownLine:
    """A source line as the terminal shows it; characters are counted as in the source."""

    def __init__(self, text: str) -> None:
        self._pieces = list(columns_of(text))
        last, column = self._pieces[-1] if self._pieces else ("", 0)
        self.width = column + cells(last)
        self._columns = [column for _, column in self._pieces]

    def column(self, character: int) -> int:
        """The column at which a character begins; past the end, one column each."""
        beyond = character - len(self._columns)
        return self._columns[character] if beyond < 0 else self.width + beyond

    def window(self, marks: Sequence[Mark], width: int) -> tuple[int, int]:
        """The range of characters to show so that the marks are seen; all if they fit."""
        if self.width <= width:
            return 0, len(self._pieces)
        first = min(self.column(mark.start) for mark in marks)
        last = max(self.column(mark.end) for mark in marks)
        spare = max(width - (last - first), width // 3)
        left = min(max(first - spare // 2, 0), self.width - width)
        end = bisect_left(self._columns, left + width)
        return bisect_left(self._columns, left), end

    def clip(self, window: tuple[int, int]) -> str:
        """The characters of the window, with a sign where something is cut off."""
        start, end = window
        shown = "".join(piece for piece, _ in self._pieces[start:end])
        before = _ELISION if start > 0 else ""
        after = _ELISION if end < len(self._pieces) else ""
        return f"{before}{shown}{after}".rstrip()

    def underline(self, mark: Mark, window: tuple[int, int]) -> Text:
        """The row below the line, with the part of `mark` that lies in the window, and its text."""
        start, end = window
        origin = self.column(start) - (1 if start > 0 else 0)
        left = self.column(mark.start)
        right = self.column(mark.end)
        if end < len(self._pieces):
            right = min(right, self.column(end))
        row = Text(" " * (left - origin))
        row.append(mark.symbol * max(right - left, 1), mark.style)
        if mark.text:
            row.append(f" {mark.text}", mark.style)
        return row
