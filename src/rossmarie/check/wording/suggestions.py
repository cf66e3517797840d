"""Suggestions: similar names, and the fix for a very similar one."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from dslkit.diagnostics import Diagnostic, DidYouMean, Edit, Fix, Label, Remark, Template
from rossmarie.syntax import ast

NEAR = 0.7
VERY_NEAR = 0.85
MOST_COMPARISONS = 50_000


class Suggestions:
    """The remaining effort for suggestions.

    Each suggestion compares all names, so a large file with many undeclared names would take too
    long.
    """

    def __init__(self) -> None:
        self._left = MOST_COMPARISONS

    def take(self, candidates: int) -> bool:
        """Say whether one more search among this number of names is allowed."""
        self._left -= candidates
        return self._left >= 0


def near_name(name: str, known: Iterable[str]) -> str | None:
    """The known name most similar to `name`, if there is one. Case does not matter."""
    by_folded = {candidate.lower(): candidate for candidate in known}
    matches = difflib.get_close_matches(name.lower(), by_folded, n=1, cutoff=NEAR)
    return by_folded[matches[0]] if matches else None


def suggesting(
    finding: Template, name: ast.Name, near: str, *labels: Label, notes: Iterable[Remark] = ()
) -> Diagnostic:
    """A finding at a name, with the name that the user probably meant."""
    help, fix = DidYouMean(near=near), rename(name, near)
    return finding.at(name.span, *labels, help=help, fix=fix, notes=notes)


def rename(name: ast.Name, near: str) -> Fix | None:
    """The fix that writes `near` instead; None if the names differ too much."""
    likeness = difflib.SequenceMatcher(None, name.text.lower(), near.lower()).ratio()
    if likeness < VERY_NEAR:
        return None
    return Fix(f"write `{near}`", (Edit(name.span, near),))
