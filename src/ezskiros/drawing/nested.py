"""The trees of a child that is a compound skill itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ezskiros.skills.calls import SkillCall
from ezskiros.trees.library import Library
from ezskiros.trees.tree import Tree


@dataclass(frozen=True)
class Nested:
    """The known trees, as trees of children."""

    trees: Sequence[Tree]
    library: Library

    def trees_of(self, call: SkillCall) -> Sequence[Tree]:
        """The trees of the implementation that will run. None if it is a primitive, is not in the
        files, or if several implementations are possible.
        """
        name = self.implementation(call)
        skill = self.library.skill(call.skill)
        return [tree for tree in self.trees if tree.implementation == name and tree.skill is skill]

    def implementation(self, call: SkillCall) -> str | None:
        """The implementation that will run: the named one, or the only one."""
        if call.implementation is not None:
            return call.implementation
        known = list(self.library.implementations(call.skill))
        return known[0] if len(known) == 1 else None
