"""The trees of a child that is a compound skill itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ezskiros.skills.calls import SkillCall
from ezskiros.trees.library import Library
from ezskiros.trees.tree import Tree


@dataclass(frozen=True)
class Nested:
    """The trees that are known, as those of children."""

    trees: Sequence[Tree]
    library: Library

    def trees_of(self, call: SkillCall) -> Sequence[Tree]:
        """The trees of what will run. None if that is a primitive, is not among the files, or if
        several implementations would do.
        """
        name = self.implementation(call)
        skill = self.library.skill(call.skill)
        return [tree for tree in self.trees if tree.implementation == name and tree.skill is skill]

    def implementation(self, call: SkillCall) -> str | None:
        """The implementation that will run: the one that is named, or the only one there is."""
        if call.implementation is not None:
            return call.implementation
        known = list(self.library.implementations(call.skill))
        return known[0] if len(known) == 1 else None
