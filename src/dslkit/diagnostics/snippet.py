"""Source lines with marks under them, between the title of a finding and its notes.

The input are labels (spans with a text); the output are rows of a terminal, as text with styles.
Any span of any text can be drawn: tabs, wide and combining characters, control characters, lines of
any length, spans over several lines, empty spans and the end of the file.
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
        """A row, with the line number if the row shows a source line."""
        number = "" if line is None else str(line)
        row = Text(f"{number:>{self.width}} |", style=GUTTER_STYLE)
        if content:
            row.append(" ")
            row.append_text(Text(content) if isinstance(content, str) else content)
        return row

    def gap(self) -> Text:
        """The row that stands for omitted lines."""
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
    """The marks of a label: one mark, or two marks at the ends of a span over several lines."""
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
    """The marked lines of a file in order, each with its marks below it in the given order."""
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
    for together in _fitting_together(text, marks, width):
        shown = _ShownLine(text, together, width)
        yield gutter.row(shown.text, together[0].line)
        yield from (gutter.row(shown.underline(mark)) for mark in together)


def _fitting_together(text: str, marks: Sequence[Mark], width: int) -> Iterator[Sequence[Mark]]:
    """All marks at once if one part of the line can show all their starts; otherwise one by one."""
    starts = [mark.start for mark in marks]
    between = text[min(starts) : max(starts)]
    if _fits(text, width) or _fits(between, width // 2 - 1):
        yield marks
    else:
        yield from ([mark] for mark in marks)


def _fits(text: str, width: int) -> bool:
    return len(text) <= width and sum(cells(shown) for shown, _ in columns_of(text)) <= width


class _ShownLine:
    """The part of a source line that the terminal shows, about `width` columns, with its marks.

    However long the line is, only the text near the first mark is read.
    """

    def __init__(self, line: str, marks: Sequence[Mark], width: int) -> None:
        first = min(mark.start for mark in marks)
        reach = 4 * width
        self._origin = max(first - reach, 0)
        pieces = list(columns_of(line[self._origin : first + reach]))
        columns = [column for _, column in pieces]
        self._columns = [*columns, columns[-1] + cells(pieces[-1][0]) if pieces else 0]
        last = max(mark.end for mark in marks)
        left = self._left_edge(first, last, width)
        start = bisect_left(columns, left)
        end = bisect_left(columns, left + width)
        is_cut = self._origin + end < len(line)
        lead = "" if self._origin + start == 0 else _ELISION
        self._shift = len(lead) - self._column(self._origin + start)
        self._end = self._columns[end] if is_cut else None
        shown = "".join(piece for piece, _ in pieces[start:end])
        self.text = f"{lead}{shown}{_ELISION if is_cut else ''}".rstrip()

    def underline(self, mark: Mark) -> Text:
        """The row below the line, with the part of `mark` that is shown, and its text."""
        left, right = self._column(mark.start), self._column(mark.end)
        if self._end is not None:
            right = min(right, self._end)
        row = Text(" " * (left + self._shift))
        row.append(mark.symbol * max(right - left, 1), mark.style)
        if mark.text:
            row.append(f" {mark.text}", mark.style)
        return row

    def _column(self, character: int) -> int:
        """The column of a character of the line, from the column of the origin. Behind the end of
        the text that is read, each character takes one column.
        """
        index = character - self._origin
        beyond = max(index - len(self._columns) + 1, 0)
        return self._columns[index - beyond] + beyond

    def _left_edge(self, first: int, last: int, width: int) -> int:
        """The first column to show, so that the marks from `first` to `last` appear in context."""
        begin, end, total = self._column(first), self._column(last), self._columns[-1]
        if total <= width:
            return 0
        spare = max(width - (end - begin), width // 3)
        return min(max(begin - spare // 2, 0), total - width)
