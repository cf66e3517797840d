"""Rejection of modules whose bytes do not match their encoding (PEP 263), wherever they are
imported.

Some versions of Python accept any byte in a comment, others reject it. A check always rejects it.
"""

from __future__ import annotations

import io
import tokenize
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.machinery import SourceFileLoader
from types import CodeType

from dslkit.diagnostics import Diagnostic, Remark
from dslkit.source import SourceFile, Span
from dslkit.source.paths import shown
from ezskiros import session
from ezskiros.skills.load_errors import NoPython

_DEFAULT = "utf-8"


@dataclass(frozen=True)
class _Fault:
    """A fault, and the position of its byte."""

    said: str
    place: int
    encoding: str = _DEFAULT
    help: Remark | None = None


class UnreadableError(SyntaxError):
    """A module that cannot be read. `diagnostic` has the place."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic.title)
        self.diagnostic = diagnostic


_get_code = SourceFileLoader.get_code


def _strict_code(loader: SourceFileLoader, name: str) -> CodeType | None:
    """The code of a module, if Python can decode all of its text, even if a compiled version
    exists.
    """
    path = loader.get_filename(name)
    if session.is_of_user(path):
        content = loader.get_data(path)
        fault = _fault(content)
        if fault is not None:
            raise UnreadableError(_finding(path, content, fault))
    return _get_code(loader, name)


@contextmanager
def reading_strictly() -> Iterator[None]:
    """While the context is active, the import of an unreadable module raises `UnreadableError`."""
    SourceFileLoader.get_code = _strict_code  # type: ignore[assignment,method-assign]
    try:
        yield
    finally:
        SourceFileLoader.get_code = _get_code  # type: ignore[method-assign]


def _finding(path: str, content: bytes, fault: _Fault) -> Diagnostic:
    file = SourceFile(shown(path), _text(content, fault.encoding))
    start = len(_text(content[: fault.place], fault.encoding))
    span = Span(file, start, min(start + 1, len(file.text)))
    return NoPython(said=fault.said).at(span, help=fault.help)


def _fault(content: bytes) -> _Fault | None:
    null = content.find(b"\0")
    if null >= 0:
        return _Fault("there is a null byte", null)
    try:
        encoding, _ = tokenize.detect_encoding(io.BytesIO(content).readline)
    except SyntaxError as problem:
        # Python detects the encoding from two lines only; later bytes that are not UTF-8 are
        # reported with their place.
        return _undecodable(content, _DEFAULT) or _Fault(str(problem), 0)
    return _undecodable(content, encoding)


def _undecodable(content: bytes, encoding: str) -> _Fault | None:
    try:
        content.decode(encoding)
    except UnicodeDecodeError as problem:
        said = f"the byte 0x{content[problem.start]:02x} is not valid in {encoding}"
        return _Fault(said, problem.start, encoding, NoPython.Encoding())
    return None


def _text(content: bytes, encoding: str) -> str:
    """The text with a mark for each undecodable byte, with Python's line ends."""
    return content.decode(encoding, "replace").replace("\r\n", "\n").replace("\r", "\n")
