"""Conversion of tree nodes to behaviors of py_trees."""

from __future__ import annotations

from collections import Counter

from py_trees.behaviour import Behaviour

from ezskiros.engine.compatible import CompatibleSkill
from ezskiros.engine.depth import MOST_DEPTH, TooDeepError
from ezskiros.engine.execution_context import ExecutionContext
from ezskiros.engine.grounding import SharedValues
from ezskiros.engine.processors import decorator, processor
from ezskiros.engine.skill import SkillChild
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.nodes import Decorator, Node, Processor


def root_skill(call: SkillCall, execution: ExecutionContext, label: str) -> SkillChild:
    """The skill of a task, at the root."""
    return _skill_class(execution)(call, SharedValues({}), execution, label, behavior)


def behavior(
    root: Node, names: SharedValues, execution: ExecutionContext, above: SkillChild | None
) -> Behaviour:
    """Build the behavior that ticks a tree: the children of the skill `above`. Raises
    `TooDeepError`.
    """
    return _Builder(names, execution, above).build(root, above.depth + 1 if above else 0)


def _skill_class(execution: ExecutionContext) -> type[SkillChild]:
    """The class that runs skills: with exact values, or with the values of SkiROS2."""
    return CompatibleSkill if execution.compatible else SkillChild


class _Builder:
    """Builds one tree."""

    def __init__(
        self, names: SharedValues, execution: ExecutionContext, above: SkillChild | None
    ) -> None:
        self._names, self._execution, self._above = names, execution, above
        self._seen: Counter[str] = Counter()
        self._skill_class = _skill_class(execution)

    def build(self, node: Node, depth: int) -> Behaviour:
        if depth > MOST_DEPTH:
            raise TooDeepError
        match node:
            case SkillCall():
                return self._skill(node, depth)
            case Processor(flow=flow, children=children):
                below = [self.build(child, depth + 1) for child in children]
                return processor(flow, below, is_compatible=self._execution.compatible)
            case Decorator():
                return decorator(node, self.build(node.child, depth + 1), self._execution)
        raise AssertionError(node)

    def _skill(self, call: SkillCall, depth: int) -> Behaviour:
        name = call.skill.__name__
        label = f"{name}.{call.implementation}" if call.implementation else name
        self._seen[label] += 1
        number = f"#{self._seen[label]}" if self._seen[label] > 1 else ""
        name = f"{label}{number}"
        return self._skill_class(
            call, self._names, self._execution, name, behavior, self._above, depth
        )
