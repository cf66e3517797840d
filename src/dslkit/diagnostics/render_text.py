"""Findings for people, on a terminal.

    error[ROSS301]: units do not match
     --> rules.ross:3:11
      |
    3 | const f = 3 N/sec
      |           ^^^^^^^ this is in N/s
      |
      = help: write a value in N

The result is `rich` text. A console prints its colours only on a terminal.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from rich.text import Text

from dslkit.diagnostics.edits import apply_edits
from dslkit.diagnostics.model import Diagnostic, Edit, Fix, Severity
from dslkit.diagnostics.snippet import GUTTER_STYLE, Gutter, Mark, draw, marks_of
from dslkit.diagnostics.visible import visible
from dslkit.source import SourceFile, ending

_SEVERITY_STYLE = {
    Severity.ERROR: "bold red",
    Severity.WARNING: "bold yellow",
    Severity.NOTE: "bold cyan",
}
_FIX_STYLE = "bold green"
_MOST_FIXED_LINES = 6


def render_text(diagnostics: Sequence[Diagnostic], *, width: int = 100) -> Text:
    """All findings, a blank line after each. Source lines longer than `width` are clipped."""
    lines = [line for found in diagnostics for line in (*_finding(found, width), Text())]
    return Text("\n").join([*lines, Text()]) if lines else Text()


def _finding(found: Diagnostic, width: int) -> Iterator[Text]:
    style = _SEVERITY_STYLE[found.severity]
    title = Text(f"{found.severity.value}[{found.code}]", style)
    yield title.append(f": {visible(found.title)}", "bold")
    gutter = Gutter(len(str(max(_line_numbers(found)))))
    marks = _marks_by_file(found, style)
    primary_file = found.primary.span.file
    for file, in_file in marks.items():
        arrow = "-->" if file is primary_file else ":::"
        place = visible(file.path)
        is_quoted = _is_quoted(file)
        if is_quoted:
            place += f":{in_file[0].line}:{in_file[0].start + 1}"
        yield Text(" " * gutter.width).append(arrow, GUTTER_STYLE).append(f" {place}")
        if is_quoted:
            yield gutter.row()
            yield from draw(file, in_file, gutter, width)
        else:
            remarks = (mark for mark in in_file if mark.text)
            yield from (gutter.row(Text(mark.text, mark.style)) for mark in remarks)
    if found.notes or found.help is not None or found.fix is not None:
        yield gutter.row()
    for note in found.notes:
        yield from gutter.attached("note", note)
    if found.help is not None:
        yield from gutter.attached("help", found.help)
    if found.fix is not None:
        yield from _fix(found.fix, gutter, width)


def _is_quoted(file: SourceFile) -> bool:
    """Say whether a file may be quoted. A link to a file of another kind may lead to a secret."""
    path = Path(file.path)
    return bool(file.text) and ending(path) == path.suffix.lower()


def _line_numbers(found: Diagnostic) -> Iterator[int]:
    for label in (found.primary, *found.labels):
        yield label.span.finish.line
    if found.fix is not None:
        added = sum(edit.replacement.count("\n") for edit in found.fix.edits)
        yield from (edit.span.finish.line + added for edit in found.fix.edits)


def _marks_by_file(found: Diagnostic, style: str) -> Mapping[SourceFile, Sequence[Mark]]:
    file = found.primary.span.file
    marks = {file: list(marks_of(found.primary, "^", style))}
    for label in found.labels:
        marks.setdefault(label.span.file, []).extend(marks_of(label, "-", GUTTER_STYLE))
    return marks


def _fix(fix: Fix, gutter: Gutter, width: int) -> Iterator[Text]:
    yield from gutter.attached("fix", fix.title)
    by_file: dict[SourceFile, list[Edit]] = {}
    for edit in fix.edits:
        by_file.setdefault(edit.span.file, []).append(edit)
    for file, edits in by_file.items():
        yield gutter.row()
        fixed = SourceFile(file.path, apply_edits(file.text, edits))
        marks = list(_replaced(edits, fixed))
        yield from draw(fixed, marks[:_MOST_FIXED_LINES], gutter, width)
        if len(marks) > _MOST_FIXED_LINES:
            yield gutter.gap()


def _replaced(edits: Iterable[Edit], fixed: SourceFile) -> Iterator[Mark]:
    """A mark for each line that the edits wrote; for a deletion, a mark at the gap."""
    shift = 0
    for edit in sorted(edits, key=lambda edit: (edit.span.start, edit.span.end)):
        start = edit.span.start + shift
        shift += len(edit.replacement) - (edit.span.end - edit.span.start)
        position = fixed.position(start)
        column = position.column - 1
        texts = edit.replacement.removesuffix("\n").split("\n")
        for line, text in enumerate(texts, start=position.line):
            symbol = "+" if text else "-"
            yield Mark(line, column, column + max(len(text), 1), symbol, _FIX_STYLE)
            column = 0
