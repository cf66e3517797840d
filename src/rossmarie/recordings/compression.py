"""Decompression within limits, of data that may be incomplete or damaged."""

from __future__ import annotations

import bz2
import sys
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Protocol

import lz4.frame

from rossmarie.recordings.limits import Allowance, LimitError

if sys.version_info >= (3, 14):
    from compression import zstd
else:
    from backports import zstd

DECOMPRESSION_FAILURES: tuple[type[Exception], ...] = (
    EOFError,
    OSError,
    RuntimeError,  # lz4
    ValueError,
    zstd.ZstdError,
)

_PIECE = 1 << 16
"""The compressed bytes that are processed at once."""
_STEP = 16 << 20
"""The bytes of content that are taken at once."""


class _Decompressor(Protocol):
    @property
    def eof(self) -> bool: ...

    @property
    def needs_input(self) -> bool: ...

    @property
    def unused_data(self) -> bytes | None: ...

    def decompress(self, data: bytes, /, max_length: int = -1) -> bytes: ...


_DECOMPRESSORS: Mapping[str, Callable[[], _Decompressor]] = {
    "bz2": bz2.BZ2Decompressor,
    "lz4": lz4.frame.LZ4FrameDecompressor,
    "zstd": zstd.ZstdDecompressor,
}
_UNCOMPRESSED = ("", "none")


def decompress_prefix(
    compression: str, data: bytes, allowance: Allowance
) -> tuple[bytes, str | None]:
    """The decompressible beginning of `data`, and the reason why the rest is missing; the reason is
    None if the content is complete.

    Raises nothing. For an unknown compression, or for data beyond a limit, there is no content.
    """
    if compression in _UNCOMPRESSED:
        return data, None
    if compression not in _DECOMPRESSORS:
        return b"", f"unknown compression `{compression}`"
    stream = _Stream(_DECOMPRESSORS[compression])
    most = allowance.chunk(len(data))
    content = bytearray()
    try:
        for start in range(0, len(data), _PIECE):
            for step in stream.feed(data[start : start + _PIECE]):
                content += step
                allowance.take(len(step))
                if len(content) > most:
                    raise LimitError(f"{len(data)} bytes decompress to more than {most >> 20} MiB")
    except LimitError as error:
        return b"", str(error)
    except DECOMPRESSION_FAILURES as error:
        return bytes(content), f"it cannot be decompressed ({error})"
    return bytes(content), None if stream.is_whole else "it is cut short"


class _Stream:
    """Compressed data in pieces: one stream, or several successive streams."""

    def __init__(self, start: Callable[[], _Decompressor]) -> None:
        self._start = start
        self._current = start()

    @property
    def is_whole(self) -> bool:
        """True if the data may end here."""
        return self._current.eof

    def feed(self, data: bytes) -> Iterator[bytes]:
        """The content of the next piece, in steps."""
        while data:
            if self._current.eof:
                self._current = self._start()
            yield self._current.decompress(data, max_length=_STEP)
            while not (self._current.needs_input or self._current.eof):
                yield self._current.decompress(b"", max_length=_STEP)
            data = (self._current.unused_data or b"") if self._current.eof else b""


def decompress(compression: str, data: bytes, allowance: Allowance) -> bytes:
    """The content of `data`. Raises `ValueError` unless the data is complete and within the
    limits.
    """
    content, trouble = decompress_prefix(compression, data, allowance)
    if trouble is not None:
        raise ValueError(trouble)
    return content


def unpacked(file: Path, folder: Path, allowance: Allowance) -> Path:
    """Decompress a file into `folder`. Returns the path of the result.

    Raises one of `DECOMPRESSION_FAILURES`, which include `LimitError`.
    """
    content = folder / file.stem
    with file.open("rb") as compressed, content.open("wb") as out:
        stream = _Stream(zstd.ZstdDecompressor)
        while packed := compressed.read(_PIECE):
            for step in stream.feed(packed):
                allowance.take(len(step))
                out.write(step)
        if not stream.is_whole:
            raise EOFError(f"`{file.name}` is cut short")
    return content
