"""The content of one message for a monitor; the same for every target."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class ChannelValues:
    """The numbers of one message, by slot and by array index, in the units of the message.

    Flags are 0.0 or 1.0, texts as in `Machine.texts`. A slot of the channel that is left out is
    NaN; an array that is left out is empty.
    """

    slots: Mapping[int, float] = field(default_factory=dict)
    arrays: Mapping[int, Sequence[float]] = field(default_factory=dict)
