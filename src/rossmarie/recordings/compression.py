"""Decompression that gives what it can of data that is cut short or damaged."""

from __future__ import annotations

import bz2
import sys
from collections.abc import Callable, Mapping
from typing import Protocol

import lz4.frame

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

_PIECE = 4096
_LARGEST_CHUNK = 1 << 30  # a few damaged bytes can stand for any amount of data


class _Decompressor(Protocol):
    @property
    def eof(self) -> bool: ...

    def decompress(self, data: bytes, /) -> bytes: ...


_DECOMPRESSORS: Mapping[str, Callable[[], _Decompressor]] = {
    "bz2": bz2.BZ2Decompressor,
    "lz4": lz4.frame.LZ4FrameDecompressor,
    "zstd": zstd.ZstdDecompressor,
}
_UNCOMPRESSED = ("", "none")


def decompress_prefix(compression: str, data: bytes) -> tuple[bytes, str | None]:
    """The content of `data` as far as it can be told, and why no further (None: it is whole).

    Raises nothing: of an unknown compression, there is no content.
    """
    if compression in _UNCOMPRESSED:
        return data, None
    if compression not in _DECOMPRESSORS:
        return b"", f"unknown compression `{compression}`"
    decompressor = _DECOMPRESSORS[compression]()
    content = bytearray()
    for start in range(0, len(data), _PIECE):
        try:
            content += decompressor.decompress(data[start : start + _PIECE])
        except DECOMPRESSION_FAILURES as error:
            return bytes(content), f"a chunk cannot be decompressed ({error})"
        if decompressor.eof:
            return bytes(content), None
        if len(content) > _LARGEST_CHUNK:
            return bytes(content), "a chunk is larger than 1 GiB"
    return bytes(content), "a chunk is cut short"
