"""Findings that a file is expected to have, written under the lines that have them.

    const f = 3 N/sec
    //        ^^^^^^^ error[ROSS301] "N/s"
    //~ warning[ROSS401]
    //    ~ note "declared here"

Carets mark the exact span (of a span over several lines: its part on the first line; of an empty
span: the character behind it). `//~` means "somewhere on that line": for spans in the first two
columns, which the `//` covers, and for findings at the end of the file. `~` marks a secondary label
of any finding of the file. The text is optional, and part of the title, a label, a note, the help
or the title of the fix. Every finding has to be expected, so a file without expectations has none.

In Python and Turtle, where comments begin with `#`, that `sign` stands for `//`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache

from dslkit.diagnostics import Diagnostic
from dslkit.source import Span

_FINDING = (
    r"""\s*{sign}(?:~|\s*(?P<carets>\^+))\s+(?P<severity>error|warning|note)\[(?P<code>\w+)\]"""
    r"""(?:\s+"(?P<text>.*)")?\s*"""
)
_NOTE = r"""\s*{sign}\s+(?P<tildes>~+)\s+note(?:\s+"(?P<text>.*)")?\s*"""


@dataclass(frozen=True)
class Expectation:
    """One expected finding, or (without `severity` and `code`) one expected label.

    `line` counts from 1; `columns` is a half-open range from 0, None for anywhere on the line.
    """

    line: int
    columns: tuple[int, int] | None
    severity: str | None
    code: str | None
    text: str | None

    def __str__(self) -> str:
        column = (
            "" if self.columns is None else f", columns {self.columns[0] + 1}-{self.columns[1]}"
        )
        what = "note" if self.code is None else f"{self.severity}[{self.code}]"
        text = "" if self.text is None else f' "{self.text}"'
        return f"line {self.line}{column}: {what}{text}"

    def comment(self, sign: str) -> str:
        """The line that states it."""
        what = "note" if self.code is None else f"{self.severity}[{self.code}]"
        text = "" if self.text is None else f' "{self.text}"'
        if self.columns is None:
            return f"{sign}~ {what}{text}"
        start, end = self.columns
        mark = "~" if self.code is None else "^"
        return f"{sign}{' ' * (start - len(sign))}{mark * (end - start)} {what}{text}"


def parse(text: str, sign: str = "//") -> tuple[Expectation, ...]:
    """The expectations stated in a file; each belongs to the last line of code before it."""
    expected = []
    code_line = 1
    for number, line in enumerate(text.split("\n"), start=1):
        stated = _stated(line, code_line, sign)
        if stated is None:
            code_line = number
        else:
            expected.append(stated)
    return tuple(expected)


def compare(text: str, found: Sequence[Diagnostic], sign: str = "//") -> list[str]:
    """The differences between the expectations in `text` and the findings in it; empty if there are
    none.

    An unexpected finding is shown as the line that would accept it.
    """
    open_findings = list(found)
    problems = []
    for expectation in sorted(parse(text, sign), key=_is_vague):
        if expectation.code is None:
            if not _has_label(expectation, text, found, sign):
                problems.append(f"expected, not found: {expectation}")
            continue
        match = next((one for one in open_findings if _fits(expectation, text, one, sign)), None)
        if match is None:
            problems.append(f"expected, not found: {expectation}")
        else:
            open_findings.remove(match)
    for one in open_findings:
        accepting = _accepting(text, one, sign)
        problems.append(
            f"found, not expected, under line {accepting.line}: {one.title}: {one.primary.text}\n"
            f"    {_line(text, accepting.line)}\n    {accepting.comment(sign)}"
        )
    return problems


def bless(text: str, found: Sequence[Diagnostic], sign: str = "//") -> str:
    """`text` with the expectations that accept exactly `found`.

    The texts and labels stated so far are kept where they still fit.
    """
    old = parse(text, sign)
    unused = [expectation for expectation in old if expectation.code is not None]
    new: dict[int, list[Expectation]] = {}
    for one in sorted(found, key=lambda one: (one.primary.span.start, one.code)):
        accepting = _accepting(text, one, sign)
        kept = next((had for had in unused if _same_finding(had, accepting, one)), None)
        if kept is not None:
            unused.remove(kept)
            accepting = Expectation(
                accepting.line, accepting.columns, accepting.severity, accepting.code, kept.text
            )
        new.setdefault(accepting.line, []).append(accepting)
    for expectation in old:
        if expectation.code is None and _has_label(expectation, text, found, sign):
            new.setdefault(expectation.line, []).append(expectation)
    return "\n".join(_blessed_lines(text, new, sign))


def _blessed_lines(text: str, new: dict[int, list[Expectation]], sign: str) -> Iterator[str]:
    for number, line in enumerate(text.split("\n"), start=1):
        if _stated(line, number, sign) is None:
            yield line
            yield from (expectation.comment(sign) for expectation in new.get(number, ()))


@cache
def _patterns(sign: str) -> tuple[re.Pattern[str], re.Pattern[str]]:
    """The patterns of lines that state a finding, and of lines that state a label."""
    finding, note = (pattern.replace("{sign}", re.escape(sign)) for pattern in (_FINDING, _NOTE))
    return re.compile(finding), re.compile(note)


def _stated(line: str, code_line: int, sign: str) -> Expectation | None:
    a_finding, a_note = _patterns(sign)
    finding = a_finding.fullmatch(line)
    if finding:
        columns = finding.span("carets") if finding["carets"] else None
        return Expectation(
            code_line, columns, finding["severity"], finding["code"], finding["text"]
        )
    note = a_note.fullmatch(line)
    if note:
        return Expectation(code_line, note.span("tildes"), None, None, note["text"])
    return None


def _is_vague(expectation: Expectation) -> bool:
    """Vague expectations are matched last, so that they leave the others their findings."""
    return expectation.columns is None


def _same_finding(old: Expectation, new: Expectation, found: Diagnostic) -> bool:
    return (old.line, old.code) == (new.line, new.code) and _says(old.text, _texts(found))


def _fits(expected: Expectation, text: str, found: Diagnostic, sign: str) -> bool:
    line, columns = _place(text, found.primary.span, sign)
    return (
        (expected.severity, expected.code) == (found.severity.value, found.code)
        and expected.line == line
        and expected.columns in (None, columns)
        and _says(expected.text, _texts(found))
    )


def _has_label(expected: Expectation, text: str, found: Iterable[Diagnostic], sign: str) -> bool:
    return any(
        _place(text, label.span, sign) == (expected.line, expected.columns)
        and _says(expected.text, (label.text,))
        for one in found
        for label in one.labels
        if label.span.file is one.primary.span.file
    )


def _says(part: str | None, texts: Iterable[str]) -> bool:
    return part is None or any(part in text for text in texts)


def _texts(found: Diagnostic) -> Iterator[str]:
    yield found.title
    yield found.primary.text
    yield from (label.text for label in found.labels)
    yield from found.notes
    if found.help is not None:
        yield found.help
    if found.fix is not None:
        yield found.fix.title


def _accepting(text: str, found: Diagnostic, sign: str) -> Expectation:
    line, columns = _place(text, found.primary.span, sign)
    if columns is not None and columns[0] < len(sign):  # carets cannot stand under the sign
        columns = None
    return Expectation(line, columns, found.severity.value, found.code, None)


def _place(text: str, span: Span, sign: str) -> tuple[int, tuple[int, int] | None]:
    """The line of code and the columns that carets have to mark; no columns at the end of code,
    which moves when an expectation is written there.
    """
    lines = text.split("\n")
    last = _last_line_of_code(lines, sign)
    begin = span.begin
    if (begin.line, begin.column) > (last, len(lines[last - 1].rstrip())):
        return last, None
    width = len(lines[begin.line - 1].rstrip("\r"))
    start = begin.column - 1
    end = span.finish.column - 1 if span.finish.line == begin.line else width
    return begin.line, (start, max(end, start + 1))


def _last_line_of_code(lines: Sequence[str], sign: str) -> int:
    for number in range(len(lines), 0, -1):
        line = lines[number - 1]
        if line.strip() and _stated(line, number, sign) is None:
            return number
    return 1


def _line(text: str, number: int) -> str:
    return text.split("\n")[number - 1]
