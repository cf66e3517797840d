"""Did you mean ...? Near names, and the fix that goes with a very near one."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from dslkit.diagnostics import Diagnostic, DidYouMean, Edit, Fix, Label, Remark, Template
from rossmarie.syntax import ast

NEAR = 0.7
VERY_NEAR = 0.85
MOST_COMPARISONS = 50_000


class Suggestions:
    """The effort that is left for suggestions.

    Each is sought among all names; a large file full of undeclared names would take for ever.
    """

    def __init__(self) -> None:
        self._left = MOST_COMPARISONS

    def take(self, candidates: int) -> bool:
        """Say whether one more suggestion may be sought among so many names."""
        self._left -= candidates
        return self._left >= 0


def near_name(name: str, known: Iterable[str]) -> str | None:
    """The known name that looks most like `name`, if any does; case does not matter."""
    by_folded = {candidate.lower(): candidate for candidate in known}
    matches = difflib.get_close_matches(name.lower(), by_folded, n=1, cutoff=NEAR)
    return by_folded[matches[0]] if matches else None


def suggesting(
    finding: Template, name: ast.Name, near: str, *labels: Label, notes: Iterable[Remark] = ()
) -> Diagnostic:
    """A finding at a name, with the one that may be meant."""
    help, fix = DidYouMean(near=near), rename(name, near)
    return finding.at(name.span, *labels, help=help, fix=fix, notes=notes)


def rename(name: ast.Name, near: str) -> Fix | None:
    """The fix that writes `near` instead; None if they differ too much to be sure."""
    likeness = difflib.SequenceMatcher(None, name.text.lower(), near.lower()).ratio()
    if likeness < VERY_NEAR:
        return None
    return Fix(f"write `{near}`", (Edit(name.span, near),))
