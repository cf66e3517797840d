"""The standard streams of a command: open, and able to write any text."""

from __future__ import annotations

import codecs
import io
import os
import sys
from pathlib import Path

_ASCII = "plain-ascii"


def make_ready() -> None:
    """Prepare the standard streams, so that no other code depends on how the command was started.

    Characters outside the encoding of a stream, and invalid bytes of file names, are written as
    escapes, as in Python strings. A closed stream is replaced by a stream that discards its input.
    """
    codecs.register(_plain_ascii)
    for number in range(3):
        _open_if_closed(number)
    nowhere = Path(os.devnull)
    sys.stdin = sys.stdin or nowhere.open(encoding="utf-8")
    sys.stdout = sys.stdout or nowhere.open("w", encoding="utf-8")
    sys.stderr = sys.stderr or nowhere.open("w", encoding="utf-8")
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            _let_take_any_text(stream)


def _open_if_closed(number: int) -> None:
    """Open a closed stream. Otherwise the next opened file would get the number of the stream, and
    receive its output.
    """
    try:
        os.fstat(number)
    except OSError:
        os.open(os.devnull, os.O_RDWR)  # the lowest free number


def _let_take_any_text(stream: io.TextIOWrapper) -> None:
    encoding = stream.encoding
    is_ascii = codecs.lookup(encoding).name == "ascii"
    stream.reconfigure(encoding=_ASCII if is_ascii else encoding, errors="backslashreplace")


def _plain_ascii(name: str) -> codecs.CodecInfo | None:
    """ASCII under another name, because Typer treats an ASCII stream as UTF-8."""
    if name.replace("_", "-") != _ASCII:
        return None
    found = codecs.lookup("ascii")
    return codecs.CodecInfo(
        found.encode,
        found.decode,
        incrementalencoder=found.incrementalencoder,
        incrementaldecoder=found.incrementaldecoder,
        name=_ASCII,
    )
