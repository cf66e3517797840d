"""The content of one message for a monitor; the same for every target."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class ChannelValues:
    """The numbers of one message, by slot and by array index, in the units of the message.

    Flags are 0.0 or 1.0, texts as in `Machine.texts`. A missing slot of the channel is NaN; a
    missing array is empty. A list with a missing column is unknown.
    """

    slots: Mapping[int, float] = field(default_factory=dict)
    arrays: Mapping[int, Sequence[float]] = field(default_factory=dict)


def known_count(values: ChannelValues, columns: Sequence[int], most: int) -> int | None:
    """The number of elements of a list with these columns in a message (S51). None if the list is
    unknown: it has more than `most` elements, a column is missing, or the columns differ in length.
    """
    counts = {len(values.arrays[column]) if column in values.arrays else None for column in columns}
    (count,) = counts if len(counts) == 1 else (None,)
    return count if count is not None and count <= most else None
