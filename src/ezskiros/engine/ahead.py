"""The skills that can start next in the tree of a task.

A running leaf will succeed or fail. The nodes that start then are ahead: the next child of a
sequence, the other child of a selector, the same child of a retry. For a compound skill, its first
children are ahead if its tree is known before it starts.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from py_trees import composites, decorators
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from ezskiros.engine.depth import MOST_DEPTH, deep
from ezskiros.engine.execution_context import ExecutionContext
from ezskiros.engine.skill import SkillChild
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import SkillInterface
from ezskiros.skills.nodes import Decorator, Flow, Node, Processor

_TOGETHER = (Flow.PARALLEL_FF, Flow.PARALLEL_FS)


@dataclass(frozen=True, eq=False)
class Ahead:
    """A skill that can start next. `values` are the known values of its parameters."""

    skill: SkillInterface
    values: Mapping[str, Any]


def skills_ahead(root: SkillChild, then: SkillCall | None = None) -> list[Ahead]:
    """The skills of a tree that can start next. For a tree that does not run, these are its first
    skills. `then` starts after the success of the tree.
    """
    with deep():
        found = _after(root)
        if then is None or not found.may_succeed:
            return list(found.skills)
        return [*found.skills, *_of_call(then, {}, root.execution, 0)]


class _After(NamedTuple):
    """The skills that can start after leaves end, and the possible results of the nodes above
    them.
    """

    skills: Sequence[Ahead]
    may_succeed: bool
    may_fail: bool


def _after(node: Behaviour) -> _After:
    if node.status is not Status.RUNNING:
        return _After(list(_beginning(node)), False, False)
    match node:
        case SkillChild(is_waiting=True):
            return _After(list(_beginning(node)), False, True)  # a time limit may end the wait
        case SkillChild(tree=None):
            return _After((), True, True)
        case SkillChild(tree=Behaviour() as tree):
            skills, may_succeed, _ = _after(tree)
            return _After(skills, may_succeed, True)  # its conditions may become false
        case composites.Sequence() | composites.Selector():
            return _after_child(node)
        case decorators.Decorator():
            return _after_decorated(node)
        case _:  # open: a parallel, whose running children are all examined
            found = [_after(each) for each in node.children if each.status is Status.RUNNING]
            skills = [skill for each in found for skill in each.skills]
            return _After(skills, any(e.may_succeed for e in found), any(e.may_fail for e in found))


def _after_child(node: composites.Sequence | composites.Selector) -> _After:
    """The child after the current one may follow in a sequence or a selector. Without memory, all
    children before it restart at each tick.
    """
    child = node.current_child
    if child is None:
        return _After((), True, True)
    found = _after(child)
    place = node.children.index(child)
    before = () if node.memory else node.children[:place]
    skills = [*found.skills, *(skill for each in before for skill in _beginning(each))]
    behind = node.children[place + 1 :]
    is_sequence = isinstance(node, composites.Sequence)
    goes_on = found.may_succeed if is_sequence else found.may_fail
    if not goes_on or not behind:
        return _After(skills, found.may_succeed, found.may_fail)
    skills += _beginning(behind[0])
    return _After(skills, found.may_succeed and not is_sequence, found.may_fail and is_sequence)


def _after_decorated(node: decorators.Decorator) -> _After:
    skills, may_succeed, may_fail = _after(node.decorated)
    if isinstance(node, decorators.Retry) and may_fail:
        skills = [*skills, *_beginning(node.decorated)]
    may_end = may_succeed or may_fail
    return _After(skills, may_end, may_end)


# --- first skills ---------------------------------------------------------------------------------


def _beginning(node: Behaviour) -> Iterator[Ahead]:
    """The first skills of a node that does not run."""
    match node:
        case SkillChild():
            yield from _of_call(node.call, node.shared, node.execution, node.depth)
        case composites.Sequence() | composites.Selector():
            if node.children:
                yield from _beginning(node.children[0])
        case decorators.Decorator():
            yield from _beginning(node.decorated)
        case _:  # open: a parallel starts all children
            for each in node.children:
                yield from _beginning(each)


def _of_call(
    call: SkillCall, shared: Mapping[str, Any], execution: ExecutionContext, depth: int
) -> Iterator[Ahead]:
    """A skill, and the first skills of its trees, with the values that its parent shares."""
    for plan in execution.plans.of(call):
        values = plan.started_with(shared)
        known = {name: value for name, value in values.items() if value is not None}
        yield Ahead(plan.skill, known)
        if plan.implementation is None or not plan.is_compound or depth > MOST_DEPTH:
            continue
        tree = execution.expansions.fixed(plan.implementation, plan.skill)
        if tree is not None:
            yield from _of_node(tree.root, values, execution, depth + 1)


def _of_node(
    node: Node, shared: Mapping[str, Any], execution: ExecutionContext, depth: int
) -> Iterator[Ahead]:
    match node:
        case SkillCall():
            yield from _of_call(node, shared, execution, depth)
        case Processor(flow=flow, children=children):
            for each in children if flow in _TOGETHER else children[:1]:
                yield from _of_node(each, shared, execution, depth)
        case Decorator(child=child):
            yield from _of_node(child, shared, execution, depth)
