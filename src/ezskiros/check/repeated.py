"""Check for two skills or implementations with the same name."""

from __future__ import annotations

from dslkit.diagnostics import Diagnostic
from dslkit.source import Span
from ezskiros.skills import errors


def repeated(found: type, place: Span, other: type, other_place: Span) -> Diagnostic:
    """The finding at the later definition."""
    libraries = {each.__module__.partition(".")[0] for each in (found, other)}
    is_packaged = all("." in each.__module__ for each in (found, other))
    twice = errors.DuplicateSkill(skill=found.__name__)
    help = twice.OfLibraries() if is_packaged and len(libraries) > 1 else None
    return twice.at(place, twice.Other().at(other_place), help=help)
