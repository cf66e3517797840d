"""The signs of comparisons, with their mirrored and opposite signs."""

from __future__ import annotations

import enum


class Comparison(enum.Enum):
    """The comparisons of two signals."""

    EQUAL = "=="
    NOT_EQUAL = "!="
    LESS = "<"
    LESS_OR_EQUAL = "<="
    GREATER = ">"
    GREATER_OR_EQUAL = ">="

    @property
    def mirrored(self) -> Comparison:
        """The equivalent comparison with exchanged sides."""
        return Comparison(_MIRRORED.get(self.value, self.value))

    @property
    def opposite(self) -> Comparison:
        """The comparison of known numbers that is true exactly if this one is false."""
        return Comparison(_OPPOSITES[self.value])


_MIRRORED = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}
_OPPOSITES = {"==": "!=", "!=": "==", "<": ">=", "<=": ">", ">": "<=", ">=": "<"}
