"""Long and deep trees: what has been found out of the same facts is not found out again."""

from __future__ import annotations

import random
from typing import Any

import pytest

from ezskiros.check.worlds import PossibleWorld
from ezskiros.contracts import judge
from ezskiros.contracts.contracts import check_tree
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.skills.markers import ParameterKind
from ezskiros.skills.nodes import Flow, Node, Processor
from ezskiros.trees.tree import IndividualReference, Tree
from support.contract_trees import OWN, Drawing, drawn

LENGTH = 40
MOST_WORLDS = 2000
"""Without what is kept there are tens of thousands."""


class compound(SkillImplementation):  # noqa: N801 - as implementations are called
    """Whose tree it is."""


@pytest.mark.parametrize("flow", [Flow.SERIAL, Flow.SELECTOR])
@pytest.mark.parametrize("is_nested", [False, True])
def test_few_worlds_are_looked_at(
    flow: Flow, is_nested: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    count = 0

    class Counted(PossibleWorld):
        def __init__(self, *args: Any) -> None:
            nonlocal count
            count += 1
            super().__init__(*args)

    monkeypatch.setattr(judge, "PossibleWorld", Counted)
    tree, library = long_tree(flow, is_nested=is_nested)
    assert check_tree(tree, library) is not None
    assert 0 < count < MOST_WORLDS


def long_tree(flow: Flow, *, is_nested: bool) -> tuple[Tree, Any]:
    """Four skills again and again, with other arguments."""
    chance = random.Random(100 + LENGTH)
    drawing = Drawing(chance, drawn(chance).rules)
    skill = drawing.skill("Compound", dict.fromkeys(OWN, ParameterKind.REQUIRED), most=4)
    first = [drawing.call(skill) for _ in range(4)]
    below = list[Node](first)
    while len(below) < LENGTH:
        given = {name: IndividualReference(chance.choice(skill.parameters)) for name in "XY"}
        below.append(SkillCall(chance.choice(first).skill, None, given, drawing.span()))
    root: Node = Processor(flow, tuple(below), drawing.span())
    if is_nested:
        root = below.pop()
        while below:
            root = Processor(flow, (below.pop(), root), drawing.span())
    return Tree(compound, skill, root, skill.span), drawing.skills
