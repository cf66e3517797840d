"""Whether the bytes of a module are of its encoding (PEP 263).

Python decodes a module less strictly when it imports it than when it runs it: in a comment, some
versions let any byte pass.
"""

from __future__ import annotations

import io
import tokenize
from dataclasses import dataclass
from pathlib import Path

from dslkit.diagnostics import Diagnostic
from dslkit.source import SourceFile, Span
from dslkit.source.paths import shown
from ezskiros.skills.load_errors import NoPython

_DEFAULT = "utf-8"
_HELP = (
    "save the file in UTF-8, or say what it is in by its first line: `# -*- coding: latin-1 -*-`"
)


@dataclass(frozen=True)
class _Fault:
    """What is wrong, and at which byte."""

    said: str
    place: int
    encoding: str = _DEFAULT
    help: str | None = None


def unreadable(path: str) -> Diagnostic | None:
    """The finding for a file that Python cannot read; None if it can, or if there is no file."""
    try:
        content = Path(path).read_bytes()
    except OSError:
        return None
    fault = _fault(content)
    if fault is None:
        return None
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
        # It looks at two lines only; what is no UTF-8 there is told with its place.
        return _undecodable(content, _DEFAULT) or _Fault(str(problem), 0)
    return _undecodable(content, encoding)


def _undecodable(content: bytes, encoding: str) -> _Fault | None:
    try:
        content.decode(encoding)
    except UnicodeDecodeError as problem:
        said = f"the byte 0x{content[problem.start]:02x} is not of {encoding}"
        return _Fault(said, problem.start, encoding, _HELP)
    return None


def _text(content: bytes, encoding: str) -> str:
    """With a mark in the place of what cannot be decoded, and lines as Python counts them."""
    return content.decode(encoding, "replace").replace("\r\n", "\n").replace("\r", "\n")
