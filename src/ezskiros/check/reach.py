"""Behavior trees that never succeed, children that are never reached, endless recursion."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dslkit.diagnostics import Diagnostic
from ezskiros.check import tree_errors as errors
from ezskiros.check.outcomes import Outcomes, goes_on_with
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.implementation import State
from ezskiros.skills.nodes import Flow, Node, Processor, calls, children
from ezskiros.trees.tree import Tree

_RESULT = {State.SUCCESS: "succeeds", State.FAILURE: "fails"}


def check_reach(trees: Sequence[Tree], outcomes: Outcomes) -> Iterator[Diagnostic]:
    """Report trees that cannot succeed and children that cannot start, tree by tree."""
    for tree in trees:
        found = [*_never_reached(tree.root, outcomes), *_started_again(tree.root, outcomes)]
        cycle = _cycle(tree, trees)
        if State.SUCCESS not in outcomes.results(tree.root) and cycle is not None:
            yield _endless(tree, cycle)
        elif State.SUCCESS not in outcomes.results(tree.root) and not found:
            never = errors.NeverSucceeds(implementation=tree.implementation)
            yield never.at(tree.span, never.Root().at(tree.root.span))
        yield from found


def _never_reached(node: Node, outcomes: Outcomes) -> Iterator[Diagnostic]:
    below = children(node)
    wanted = goes_on_with(node.flow) if isinstance(node, Processor) else None
    for index, child in enumerate(below[:-1]):
        if wanted is not None and wanted not in outcomes.results(child):
            found = errors.NeverReached(result=_RESULT[wanted])
            before = found.Before(result=_RESULT[wanted])
            yield found.at(below[index + 1].span, before.at(child.span))
            break
    for child in below:
        yield from _never_reached(child, outcomes)


def _started_again(node: Node, outcomes: Outcomes) -> Iterator[Diagnostic]:
    """Report children of a Serial that take time and come before other children that take time."""
    if isinstance(node, Processor) and node.flow is Flow.SERIAL:
        long = [child for child in node.children if outcomes.is_long(child)]
        for child in long[1:]:
            found = errors.StartedAgain()
            yield found.at(child.span, found.Before().at(long[0].span))
    for child in children(node):
        yield from _started_again(child, outcomes)


def _cycle(tree: Tree, trees: Sequence[Tree]) -> list[SkillCall] | None:
    """The calls that lead from a tree to itself; None if there is no recursion."""
    by_skill: dict[type, list[Tree]] = {}
    for each in trees:
        by_skill.setdefault(each.owner.description, []).append(each)
    seen: set[int] = set()
    paths: list[tuple[Tree, list[SkillCall]]] = [(tree, [])]
    while paths:
        current, path = paths.pop()
        for call in calls(current.root):
            for called in by_skill.get(call.skill, []):
                if call.implementation not in (None, called.implementation):
                    continue
                if called.owner is tree.owner:
                    return [*path, call]
                if id(called) not in seen:
                    seen.add(id(called))
                    paths.append((called, [*path, call]))
    return None


def _endless(tree: Tree, cycle: Sequence[SkillCall]) -> Diagnostic:
    path = " > ".join([tree.skill.name, *(call.skill.__name__ for call in cycle)])
    found = errors.EndlessRecursion(implementation=tree.implementation, path=path)
    labels = [found.Calls().at(call.span) for call in cycle[1:]]
    return found.at(cycle[0].span, *labels)
