"""What can be told of compressed data that is not whole."""

from __future__ import annotations

import bz2
import sys
from collections.abc import Callable

import lz4.frame
import numpy as np
import pytest

from rossmarie.recordings.compression import decompress_prefix

if sys.version_info >= (3, 14):
    from compression import zstd
else:
    from backports import zstd

# Enough for several blocks of each format (bz2 has the largest, 900 kB), and incompressible.
CONTENT = np.random.default_rng(7).bytes(3_000_000)
COMPRESS: dict[str, Callable[[bytes], bytes]] = {
    "bz2": bz2.compress,
    "lz4": lz4.frame.compress,
    "zstd": zstd.compress,
    "none": bytes,
    "": bytes,
}


@pytest.mark.parametrize("compression", COMPRESS)
def test_whole_data(compression: str) -> None:
    assert decompress_prefix(compression, COMPRESS[compression](CONTENT)) == (CONTENT, None)


@pytest.mark.parametrize("compression", ["bz2", "lz4", "zstd"])
def test_data_cut_short(compression: str) -> None:
    data = COMPRESS[compression](CONTENT)
    content, trouble = decompress_prefix(compression, data[: len(data) * 2 // 3])
    assert CONTENT.startswith(content)
    assert len(content) > 800_000
    assert trouble == "a chunk is cut short"


def test_damaged_data() -> None:
    """bz2 is the one of them that checks every block."""
    data = bytearray(bz2.compress(CONTENT))
    data[len(data) * 2 // 3] ^= 0xFF
    content, trouble = decompress_prefix("bz2", bytes(data))
    assert CONTENT.startswith(content)
    assert len(content) > 800_000
    assert trouble is not None
    assert "cannot be decompressed" in trouble


def test_unknown_compression() -> None:
    assert decompress_prefix("rar", CONTENT) == (b"", "unknown compression `rar`")
