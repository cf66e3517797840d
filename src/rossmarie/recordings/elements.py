"""Named elements: their places in the arrays of each message, and the findings about elements that
never occur.
"""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from dataclasses import dataclass, field

from dslkit.diagnostics import Diagnostic, DidYouMean, Remark
from rossmarie.ir import ByName, Doing, Listed, Machine, Quantity, SkillStep, Slot
from rossmarie.recordings.errors import (
    LengthNeverRecorded,
    NameNeverRecorded,
    SkillsOfAnotherExport,
)
from rossmarie.recordings.matching import field_text, input_span, lengths, listed

_MOST_OTHERS = 64
"""The names or lengths that are kept for a message. A reader needs no more."""
_DIGITS = 12
"""The reported digits of a digest."""

Named = ByName | Listed
"""An element that is identified by a name."""


def place_of(element: Named, names: Sequence[str], length: int) -> int | None:
    """The place of an element in an array of this length; `names` are the names in the message."""
    match element:
        case ByName():
            return element.place(names, length)
        case Listed():
            return element.place_among(length)


@dataclass
class ElementSearch:
    """The search for a named element in successive messages. It notes whether any message had the
    element, and some of the names, or array lengths, of the messages. For a query about skills, it
    notes whether a message came from the query's export, and the other exports.
    """

    slot: Slot
    is_found: bool = False
    others: dict[str, None] = field(default_factory=dict)

    def place(self, element: Named, names: Sequence[str], length: int) -> int | None:
        """The place of the element, as from `place_of`."""
        self.is_found = self.is_found or _is_there(element, names, length)
        if not self.is_found and len(self.others) < _MOST_OTHERS:
            self.others.update(dict.fromkeys(_instead(element, names, length)))
        return place_of(element, names, length)

    def see_export(self, query: SkillStep, digest: str) -> None:
        """Note the export of a message."""
        self.is_found = self.is_found or digest == query.export
        if not self.is_found and len(self.others) < _MOST_OTHERS:
            self.others[digest] = None

    @property
    def is_vain(self) -> bool:
        """True if no message has had the element so far, although some messages had other
        elements.
        """
        return bool(self.others) and not self.is_found


def _is_there(element: Named, names: Sequence[str], length: int) -> bool:
    match element:
        case ByName():
            return element.is_among(names)
        case Listed(count=count):
            return length == count


def _instead(element: Named, names: Sequence[str], length: int) -> Sequence[str]:
    match element:
        case ByName():
            return names[:_MOST_OTHERS]
        case Listed():
            return (str(length),)


def never_found(topic: str, search: ElementSearch, machine: Machine) -> Diagnostic:
    """The finding that a search failed."""
    path, span = search.slot.path, input_span(machine, search.slot.input)
    by = next(step for step in path if isinstance(step, ByName | Listed | Doing | Quantity))
    match by:
        case Doing(export=export) | Quantity(export=export):
            recorded = listed(each[:_DIGITS] or "none" for each in search.others)
            return SkillsOfAnotherExport(
                topic=topic, known=f"`{export[:_DIGITS]}`", recorded=recorded
            ).at(span)
        case ByName(key=key):
            finding = NameNeverRecorded(
                topic=topic, element=key, field=field_text(path), names=listed(search.others)
            )
            near = difflib.get_close_matches(key, search.others, n=1)
            help: Remark = DidYouMean(near=near[0]) if near else finding.Check()
            return finding.at(span, help=help)
        case Listed(count=count):
            field, found = field_text(path[:-1]), lengths(map(int, search.others))
            unlike = LengthNeverRecorded(topic=topic, field=field, count=count, lengths=found)
            return unlike.at(span)
