"""Two skills or implementations of one name."""

from __future__ import annotations

from dslkit.diagnostics import Diagnostic, Label
from dslkit.source import Span
from ezskiros.skills import errors

_OF_LIBRARIES = (
    "give one of them another name: of two libraries SkiROS2 takes that of the first in "
    "`libraries_list`"
)


def repeated(found: type, place: Span, other: type, other_place: Span) -> Diagnostic:
    """The finding at the later one."""
    libraries = {each.__module__.partition(".")[0] for each in (found, other)}
    is_packaged = all("." in each.__module__ for each in (found, other))
    help = _OF_LIBRARIES if is_packaged and len(libraries) > 1 else None
    label = Label(other_place, "the other one")
    return errors.DuplicateSkill(skill=found.__name__).at(place, label, help=help)
