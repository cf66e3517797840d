"""The tree of a compound skill for the current values of its parameters.

`expandBT` runs when a compound starts, so that its branches depend on the actual values. It does
not run again for the same values, and it runs only once if its tree does not depend on values.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from dslkit.source import Span
from ezskiros import session
from ezskiros.engine import user_code
from ezskiros.engine.events import Code, Reason
from ezskiros.ontology.symbols import depends_on_symbol
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.skills.interface import SkillInterface
from ezskiros.skills.nodes import Decorator, Node, children
from ezskiros.skills.syntax import class_span
from ezskiros.skills.values import Symbol
from ezskiros.trees.build import EmptyTreeError, build
from ezskiros.trees.expand import expand
from ezskiros.trees.tree import Tree, ValueReference

_Implementation = type[SkillImplementation]


class Expansions:
    """The known trees, by implementation: trees that a check has found, and other ones."""

    def __init__(self, trees: Iterable[Tree] = ()) -> None:
        self._trees: dict[Span, list[Tree]] = {}
        for tree in trees:
            self._trees.setdefault(tree.span, []).append(tree)
        self._fixed: dict[_Implementation, Tree | None] = {}
        self._by_values: dict[tuple[_Implementation, tuple[object, ...]], Tree | Reason] = {}

    def tree(
        self, implementation: _Implementation, skill: SkillInterface, values: Mapping[str, Any]
    ) -> Tree | Reason:
        """The tree for some values, or the reason why there is none."""
        fixed = self.fixed(implementation, skill)
        if fixed is not None:
            return fixed
        known = {each.name: values[each.name] for each in skill.parameters}
        individuals = {each.name for each in skill.parameters if each.is_individual}
        reported = (
            value is not None if name in individuals else value for name, value in known.items()
        )
        key = (implementation, tuple(reported))
        if key not in self._by_values:
            self._by_values[key] = _built(implementation, skill, known)
        return self._by_values[key]

    def fixed(self, implementation: _Implementation, skill: SkillInterface) -> Tree | None:
        """The tree for all values; None if the tree depends on values."""
        if implementation not in self._fixed:
            self._fixed[implementation] = self._only_tree(implementation, skill)
        return self._fixed[implementation]

    def _only_tree(self, implementation: _Implementation, skill: SkillInterface) -> Tree | None:
        """The tree if there is one for all values; None if the tree depends on values."""
        trees = self._trees.get(class_span(implementation))
        if trees is None:
            with session.trying():
                trees = list(expand(implementation, skill))
        return trees[0] if len(trees) == 1 and _is_fixed(trees[0].root) else None


def _is_fixed(root: Node) -> bool:
    """Say whether no value in a tree is computed from parameters."""
    work: list[Node] = [root]
    while work:
        node = work.pop()
        work += children(node)
        if isinstance(node, SkillCall) and any(map(_is_computed, node.arguments.values())):
            return False
        if isinstance(node, Decorator) and isinstance(node.limit, Symbol):
            return False
    return True


def _is_computed(value: object) -> bool:
    if type(value) in (int, float, bool):
        return False
    if type(value) is str:
        return depends_on_symbol(value)
    is_passed = isinstance(value, ValueReference)
    return not is_passed and isinstance(value, Symbol)


def _built(
    implementation: _Implementation, skill: SkillInterface, known: Mapping[str, object]
) -> Tree | Reason:
    try:
        root = build(implementation, skill, known)
    except (EmptyTreeError, session.SkillError) as problem:
        return Reason(Code.START, str(problem))
    except (Exception, SystemExit) as problem:
        return user_code.raised(problem, "expandBT", Code.START)
    return Tree(implementation, skill, root, class_span(implementation))
