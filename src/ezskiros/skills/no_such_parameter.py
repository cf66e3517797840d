"""The finding for a parameter of an implementation that its skill does not have."""

from __future__ import annotations

import difflib

from dslkit.diagnostics import Diagnostic, DidYouMean
from dslkit.source import Span
from ezskiros.skills import tree_errors as errors
from ezskiros.skills.interface import SkillInterface


def no_such_parameter(skill: SkillInterface, name: str, place: Span) -> Diagnostic:
    """The finding, with a similar parameter."""
    near = difflib.get_close_matches(name, [each.name for each in skill.parameters], n=1)
    help = DidYouMean(near=near[0]) if near else None
    return errors.NoSuchParameter(skill=skill.name, spelled=name).at(place, help=help)
