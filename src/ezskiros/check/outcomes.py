"""The possible results of nodes of behavior trees, as far as implementations show them.

A skill can always fail: its pre-conditions may be false when it starts.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ezskiros.skills.calls import SkillCall
from ezskiros.skills.implementation import SkillImplementation, State
from ezskiros.skills.methods import reported_states
from ezskiros.skills.nodes import Decoration, Decorator, Flow, Node, Processor, children
from ezskiros.trees.library import Library
from ezskiros.trees.tree import Tree

Results = frozenset[State]
_NONE: Results = frozenset()
_FAILURE: Results = frozenset({State.FAILURE})
_SUCCESS: Results = frozenset({State.SUCCESS})
_OTHER = {State.SUCCESS: State.FAILURE, State.FAILURE: State.SUCCESS}


class Outcomes:
    """The results of the nodes of trees that may call each other."""

    def __init__(self, trees: Iterable[Tree], library: Library) -> None:
        self._library = library
        self._trees: dict[type[SkillImplementation], list[Node]] = {}
        for tree in trees:
            self._trees.setdefault(tree.owner, []).append(tree.root)
        self._succeeding: set[type[SkillImplementation]] = set()
        self._long: set[type[SkillImplementation]] = set()
        while self._grow():
            pass

    def _grow(self) -> bool:
        """Make one more step to the least fixed point: a recursive tree succeeds only if a path
        avoids the recursion.
        """
        before = len(self._succeeding) + len(self._long)
        for owner, roots in self._trees.items():
            if any(State.SUCCESS in self.results(root) for root in roots):
                self._succeeding.add(owner)
            if any(self.is_long(root) for root in roots):
                self._long.add(owner)
        return len(self._succeeding) + len(self._long) > before

    def results(self, node: Node) -> Results:
        """The possible results of a node."""
        match node:
            case SkillCall():
                return _FAILURE | (_SUCCESS if self._can_succeed(node) else _NONE)
            case Decorator(decoration=Decoration.INVERTER, child=child):
                return frozenset(_OTHER[each] for each in self.results(child))
            case Decorator(decoration=Decoration.TIMEOUT, child=child):
                return self.results(child) | _FAILURE
            case Decorator(decoration=Decoration.RETRY, child=child):
                return self.results(child)
            case Decorator():
                raise AssertionError(node)
            case Processor(flow=flow, children=below):
                return _joined(flow, [self.results(child) for child in below])

    def is_long(self, node: Node) -> bool:
        """Say whether an implementation may take more than one tick."""
        if not isinstance(node, SkillCall):
            return any(self.is_long(child) for child in children(node))
        return any(
            each in self._long if each in self._trees else "step" in (reported_states(each) or ())
            for each in self._library.doing(node)
        )

    def _can_succeed(self, call: SkillCall) -> bool:
        known = self._library.doing(call)
        return not known or any(map(self._succeeds, known))

    def _succeeds(self, implementation: type[SkillImplementation]) -> bool:
        if implementation in self._trees:
            return implementation in self._succeeding
        reported = reported_states(implementation)
        return reported is None or "success" in reported


def _joined(flow: Flow, results: Sequence[Results]) -> Results:
    """The results of a processor, given the possible results of its children."""
    match flow:
        case Flow.SERIAL | Flow.SERIAL_STAR | Flow.PARALLEL_FF:
            all_can = all(State.SUCCESS in each for each in results)
            reached = results[: _reached(results, State.SUCCESS)]
            can_fail = any(State.FAILURE in each for each in reached)
            return (_SUCCESS if all_can else _NONE) | (_FAILURE if can_fail else _NONE)
        case Flow.SELECTOR | Flow.SELECTOR_STAR:
            all_can = all(State.FAILURE in each for each in results)
            reached = results[: _reached(results, State.FAILURE)]
            can_succeed = any(State.SUCCESS in each for each in reached)
            return (_SUCCESS if can_succeed else _NONE) | (_FAILURE if all_can else _NONE)
        case Flow.PARALLEL_FS:
            return _NONE.union(*results)
        case Flow.NO_FAIL:
            return _SUCCESS if all(results) else _NONE


def _reached(results: Sequence[Results], wanted: State) -> int:
    """The number of children that can start, if each child needs this result of all children before
    it.
    """
    for index, each in enumerate(results):
        if wanted not in each:
            return index + 1
    return len(results)


def goes_on_with(flow: Flow) -> State | None:
    """The result of a child after which a processor starts the next child."""
    match flow:
        case Flow.SERIAL | Flow.SERIAL_STAR:
            return State.SUCCESS
        case Flow.SELECTOR | Flow.SELECTOR_STAR:
            return State.FAILURE
        case Flow.PARALLEL_FF | Flow.PARALLEL_FS | Flow.NO_FAIL:
            return None
