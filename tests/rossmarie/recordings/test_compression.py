"""Messages about incomplete compressed data."""

from __future__ import annotations

import bz2
import sys
from collections.abc import Callable

import lz4.frame
import numpy as np
import pytest

from rossmarie.recordings import limits
from rossmarie.recordings.compression import decompress_prefix
from rossmarie.recordings.limits import Allowance

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
    assert decompress_prefix(compression, COMPRESS[compression](CONTENT), Allowance(0)) == (
        CONTENT,
        None,
    )


@pytest.mark.parametrize("compression", ["bz2", "lz4", "zstd"])
def test_data_cut_short(compression: str) -> None:
    data = COMPRESS[compression](CONTENT)
    content, trouble = decompress_prefix(compression, data[: len(data) * 2 // 3], Allowance(0))
    assert CONTENT.startswith(content)
    assert len(content) > 800_000
    assert trouble == "it is cut short"


def test_damaged_data() -> None:
    """bz2 is the one of them that checks every block."""
    data = bytearray(bz2.compress(CONTENT))
    data[len(data) * 2 // 3] ^= 0xFF
    content, trouble = decompress_prefix("bz2", bytes(data), Allowance(0))
    assert CONTENT.startswith(content)
    assert len(content) > 800_000
    assert trouble is not None
    assert "cannot be decompressed" in trouble


def test_unknown_compression() -> None:
    assert decompress_prefix("rar", CONTENT, Allowance(0)) == (b"", "unknown compression `rar`")


@pytest.mark.parametrize("compression", ["bz2", "lz4", "zstd"])
def test_streams_that_follow_each_other(compression: str) -> None:
    data = COMPRESS[compression](b"one ") + COMPRESS[compression](b"two")
    assert decompress_prefix(compression, data, Allowance(0)) == (b"one two", None)


@pytest.mark.parametrize("compression", ["bz2", "zstd"])
def test_more_than_a_limit_gives_nothing(compression: str) -> None:
    data = COMPRESS[compression](bytes(limits.SMALL_CHUNK + 1))
    content, trouble = decompress_prefix(compression, data, Allowance(0))
    assert content == b""
    assert trouble == f"{len(data)} bytes decompress to more than 64 MiB"


def test_what_its_bytes_can_stand_for_may_be_large() -> None:
    size = limits.SMALL_CHUNK // limits.HIGHEST_RATIO + 1
    assert Allowance(0).chunk(size) > limits.SMALL_CHUNK
    assert Allowance(0).chunk(1 << 40) == limits.LARGEST_CHUNK


def test_an_allowance_is_for_all_chunks_together() -> None:
    allowance = Allowance(0)
    data = zstd.compress(bytes(limits.SMALL_CHUNK))
    for _ in range(limits.SMALL_RECORDING // limits.SMALL_CHUNK):
        assert decompress_prefix("zstd", data, allowance)[1] is None
    content, trouble = decompress_prefix("zstd", data, allowance)
    assert content == b""
    assert trouble is not None
    assert "too large for the size of the file" in trouble


def test_metadata_that_doubles_with_each_line_is_not_read() -> None:
    with pytest.raises(limits.LimitError, match="<<"):
        limits.check_yaml("a: &a {}\nb: {<<: [*a, *a]}")
    with pytest.raises(limits.LimitError, match="4 MiB"):
        limits.check_yaml(" " * (limits.LARGEST_METADATA + 1))
