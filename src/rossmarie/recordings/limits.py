"""Limits of recordings: a few bytes of one never cost gigabytes of memory or minutes of time.

The page docs/reference/limits.md lists these limits, with the reasons.
"""

from __future__ import annotations

LARGEST_CHUNK = 256 << 20
"""Bytes of a chunk, or of a message that is compressed by itself, when decompressed."""
SMALL_CHUNK = 64 << 20
"""Bytes up to which a chunk may be, however few its compressed bytes are."""
HIGHEST_RATIO = 250
"""Decompressed bytes for each compressed one, of what is larger."""
SMALL_RECORDING = 256 << 20
"""Bytes up to which a recording may be when decompressed, however few its bytes are."""
MOST_MESSAGES = 1_000_000
"""Messages of a recording, besides one for each `BYTES_OF_A_MESSAGE` of its bytes."""
BYTES_OF_A_MESSAGE = 8
LONGEST_LINE = 16 << 20
"""Characters of a line of a CSV file."""
DEEPEST_TYPE = 50
"""The most message types that may lie in each other."""
LONGEST_FIXED_ARRAY = 1000
"""Elements of an array of fixed length in a definition, unless they are numbers."""
MOST_FIELDS = 100_000
"""Fields of a message type, those of its parts included."""
MOST_ELEMENTS = 4_000_000
"""Texts and messages in the arrays of one message."""
LARGEST_METADATA = 4 << 20
"""Bytes of the YAML in a recording, which is slow to read."""


class LimitError(ValueError):
    """A recording is beyond a limit; the text says which."""


class Allowance:
    """The most bytes to which the files of one recording, of so many bytes in all, may still be
    decompressed.
    """

    def __init__(self, size: int) -> None:
        self._left = SMALL_RECORDING + HIGHEST_RATIO * size
        self.messages = MOST_MESSAGES + size // BYTES_OF_A_MESSAGE
        """The most messages that may be in it."""

    def chunk(self, size: int) -> int:
        """The most bytes that `size` compressed ones may become."""
        return min(LARGEST_CHUNK, max(SMALL_CHUNK, HIGHEST_RATIO * size))

    def take(self, size: int) -> None:
        """Raises `LimitError` if it is too much for the recording."""
        if size > self._left:
            raise LimitError("its decompressed data is too large for the size of the file")
        self._left -= size


def check_yaml(text: str) -> None:
    """Raises `LimitError` for YAML that is too slow to read: mappings that merge others (`<<`) can
    double with each line.
    """
    if len(text) > LARGEST_METADATA:
        raise LimitError(f"its metadata is larger than {LARGEST_METADATA >> 20} MiB")
    if "<<" in text:
        raise LimitError("its metadata merges mappings (`<<`)")
