"""The signs of comparisons, and which of them say the same of exchanged sides, or the opposite."""

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
        """The comparison that says the same with its sides exchanged."""
        return Comparison(_MIRRORED.get(self.value, self.value))

    @property
    def opposite(self) -> Comparison:
        """The comparison that holds of known numbers where this one does not."""
        return Comparison(_OPPOSITES[self.value])


_MIRRORED = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}
_OPPOSITES = {"==": "!=", "!=": "==", "<": ">=", "<=": ">", ">": "<=", ">=": "<"}
