"""Reading of JSON lines from external files, with errors that name the place.

Sizes are limited, and types are strict: no number is accepted as a text, and NaN is not a number.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NoReturn, TypeAlias, TypeVar

from dslkit.diagnostics import Diagnostic, Remark
from dslkit.source import SourceFile, Span, shown
from ezskiros.learning.errors import NoKnowledge, NoRecord

LARGEST_RECORD = 1 << 26
"""The most bytes of a file. A run of a day has fewer."""
LATEST_NS = (1 << 63) - 1
"""The last stamp. Clocks count nanoseconds in 64 bits."""
Fault: TypeAlias = type[NoRecord] | type[NoKnowledge]
_Kind = TypeVar("_Kind")
_KINDS: dict[type, str] = {
    str: "a text",
    int: "an integer",
    bool: "true or false",
    list: "a list",
    dict: "an object",
}


class RecordError(Exception):
    """A file that cannot be used. The diagnostic gives the reason."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic.title)
        self.diagnostic = diagnostic


@dataclass(frozen=True)
class RecordLine:
    """A JSON object: a line of a file, or an object in it. All methods raise `RecordError` with a
    `fault`.
    """

    span: Span
    values: dict[str, Any]
    fault: Fault = NoRecord

    def fail(self, reason: str, key: str = "", help: Remark | None = None) -> NoReturn:
        """Raise the error for this object, at one of its keys if the key exists."""
        at = self.span.text.find(f'"{key}"') if key else -1
        place = self.span
        if at >= 0:
            start = self.span.start + at
            place = Span(self.span.file, start, start + len(key) + 2)
        found = self.fault(path=self.span.file.path, reason=reason)
        raise RecordError(found.at(place, help=help))

    def below(self, values: dict[str, Any]) -> RecordLine:
        """A nested object."""
        return replace(self, values=values)

    def _located(self, values: dict[str, Any], after: int) -> RecordLine:
        """A nested object, with its place if the text is in the format of Python's `json`
        module.
        """
        text = json.dumps(values)
        start = self.span.file.text.find(text, after, self.span.end)
        span = Span(self.span.file, start, start + len(text)) if start >= 0 else self.span
        return RecordLine(span, values, self.fault)

    def get(self, key: str, kind: type[_Kind]) -> _Kind:
        """The value of a key, which must exist and have this type."""
        value = self.values.get(key)
        if type(value) is not kind:
            there = "is missing" if key not in self.values else f"is not {_KINDS[kind]}"
            self.fail(f"`{key}` {there}", key)
        return value

    def stamp(self, key: str) -> int:
        """A stamp in nanoseconds."""
        found = self.get(key, int)
        if not 0 <= found <= LATEST_NS:
            self.fail(f"`{key}` is not a time stamp in nanoseconds", key)
        return found

    def count(self, key: str) -> int:
        """A number of items."""
        found = self.get(key, int)
        if found < 0:
            self.fail(f"`{key}` is less than 0", key)
        return found

    def seconds(self, key: str) -> float:
        """A duration in seconds."""
        found = self.values.get(key)
        is_number = type(found) in (int, float)
        if not is_number or not 0 <= found <= LATEST_NS / 1e9:  # type: ignore[operator]
            self.fail(f"`{key}` is not a duration in seconds", key)
        return float(found)  # type: ignore[arg-type]

    def objects(self, key: str) -> Iterator[RecordLine]:
        """A list of objects. They have their own places, up to the first one that is not found in
        the text.
        """
        after, is_found = self.span.start, True
        for each in self.get(key, list):
            if not isinstance(each, dict):
                self.fail(f"`{key}` is not a list of objects", key)
            line = self._located(each, after) if is_found else self.below(each)
            is_found, after = line.span is not self.span, line.span.start
            yield line

    def texts(self, key: str) -> tuple[str, ...]:
        """A list of texts."""
        found = self.get(key, list)
        if not all(isinstance(each, str) for each in found):
            self.fail(f"`{key}` is not a list of strings", key)
        return tuple(found)


def read_text(path: Path, fault: Fault = NoRecord) -> SourceFile:
    """An external file. Raises `RecordError`, and `OSError` if it cannot be read."""
    file = SourceFile(shown(str(path)), "")
    with path.open("rb") as opened:
        content = opened.read(LARGEST_RECORD + 1)
    whole = RecordLine(Span(file, 0, 0), {}, fault)
    if len(content) > LARGEST_RECORD:
        whole.fail(f"it is larger than {LARGEST_RECORD >> 20} MiB")
    try:
        return SourceFile.decoded(file.path, content)
    except UnicodeDecodeError as problem:
        whole.fail(f"byte {problem.start + 1} is not UTF-8")


def lines(file: SourceFile) -> Iterator[RecordLine]:
    """The lines of a file, each a JSON object. Raises `RecordError`."""
    start = 0
    for text in file.text.split("\n"):
        span = Span(file, start, start + len(text))
        start += len(text) + 1
        if text.strip():
            yield RecordLine(span, _object(span))


def parsed(text: str) -> Any:
    """Parse JSON. Raises `json.JSONDecodeError`, `ValueError` and `RecursionError`."""
    return json.loads(text, parse_constant=_refuse_constant)


def _refuse_constant(spelled: str) -> None:
    raise ValueError(f"`{spelled}` is not a JSON number")


def _object(span: Span) -> dict[str, Any]:
    try:
        found = parsed(span.text)
    except json.JSONDecodeError as problem:
        at = span.start + min(problem.pos, max(len(span.text) - 1, 0))
        where = Span(span.file, at, min(at + 1, span.end))
        RecordLine(where, {}).fail(f"this is not JSON ({problem.msg})")
    except (ValueError, RecursionError) as problem:
        RecordLine(span, {}).fail(
            str(problem) if isinstance(problem, ValueError) else "its nesting is too deep"
        )
    if not isinstance(found, dict):
        RecordLine(span, {}).fail("this is not a JSON object")
    return found
