"""Limits of recordings: a few bytes never cost gigabytes of memory or minutes of time.

The page docs/reference/limits.md lists these limits, with the reasons.
"""

from __future__ import annotations

LARGEST_CHUNK = 256 << 20
"""The most bytes of a decompressed chunk, or of a message that is compressed on its own."""
SMALL_CHUNK = 64 << 20
"""A chunk up to this size in bytes is allowed, however few its compressed bytes are."""
HIGHEST_RATIO = 250
"""The most decompressed bytes for each compressed byte, for larger chunks."""
SMALL_RECORDING = 256 << 20
"""A decompressed recording up to this size in bytes is allowed, however few its bytes are."""
MOST_MESSAGES = 1_000_000
"""The most messages of a recording, in addition to one for each `BYTES_OF_A_MESSAGE` of its
bytes.
"""
BYTES_OF_A_MESSAGE = 8
LONGEST_LINE = 16 << 20
"""The most characters in a line of a CSV file."""
DEEPEST_TYPE = 50
"""The greatest depth of nested message types."""
LONGEST_FIXED_ARRAY = 1000
"""The most elements of an array of fixed length in a definition, unless they are numbers."""
MOST_FIELDS = 100_000
"""The most fields of a message type, including the fields of nested types."""
MOST_ELEMENTS = 4_000_000
"""The most texts and messages in the arrays of one message."""
LARGEST_METADATA = 4 << 20
"""The most bytes of YAML in a recording, because YAML is slow to read."""


class LimitError(ValueError):
    """A recording exceeds a limit; the text describes the limit."""


class Allowance:
    """The most bytes to which the files of one recording may still be decompressed. `size` is the
    number of bytes of all files.
    """

    def __init__(self, size: int) -> None:
        self._left = SMALL_RECORDING + HIGHEST_RATIO * size
        self.messages = MOST_MESSAGES + size // BYTES_OF_A_MESSAGE
        """The most messages that the recording may contain."""

    def chunk(self, size: int) -> int:
        """The most bytes to which `size` compressed bytes may be decompressed."""
        return min(LARGEST_CHUNK, max(SMALL_CHUNK, HIGHEST_RATIO * size))

    def take(self, size: int) -> None:
        """Count decompressed bytes. Raises `LimitError` if there are too many for the recording."""
        if size > self._left:
            raise LimitError("its decompressed data is too large for the size of the file")
        self._left -= size


def check_yaml(text: str) -> None:
    """Raises `LimitError` for YAML that is too slow to read: mappings that merge other mappings
    (`<<`) can double in size with each line.
    """
    if len(text) > LARGEST_METADATA:
        raise LimitError(f"its metadata is larger than {LARGEST_METADATA >> 20} MiB")
    if "<<" in text:
        raise LimitError("its metadata merges mappings (`<<`)")
