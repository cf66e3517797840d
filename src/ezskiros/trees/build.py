"""The tree of a starting compound skill: `expandBT`, run on the values of its parameters."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ezskiros.skills.growing import growing
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.skills.interface import SkillInterface
from ezskiros.skills.nodes import Node
from ezskiros.trees.expand import References


class EmptyTreeError(LookupError):
    """`expandBT` builds no tree for these values."""


def build(
    implementation: type[SkillImplementation], skill: SkillInterface, known: Mapping[str, object]
) -> Node:
    """The root of the tree. The execution is not guarded, because the check has followed all paths.

    `known` has the values of all parameters, None for those without a value; for individuals, only
    the presence matters. Raises the exceptions of `expandBT`, `SkillError` for a mistake that only
    these values show, and `EmptyTreeError`.
    """
    written: Any = implementation()
    with growing() as tree:
        written.expandBT(References(skill, known))
    if not tree.loose:
        raise EmptyTreeError(f"`{implementation.__name__}` has no behavior tree")
    root: Node = tree.loose[-1]
    return root
