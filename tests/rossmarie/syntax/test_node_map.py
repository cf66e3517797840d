"""Facts about expressions are kept by the node itself."""

from __future__ import annotations

import gc
import weakref

import pytest

from dslkit.source import SourceFile, Span
from rossmarie.syntax import ast
from rossmarie.syntax.node_map import NodeMap

SPAN = Span(SourceFile("rules.ross", "docked"), 0, 6)


def node() -> ast.Reference:
    return ast.Reference(ast.Name("docked", SPAN), SPAN)


def test_nodes_that_look_alike_have_facts_of_their_own() -> None:
    one, other = node(), node()
    assert one == other
    facts: NodeMap[int] = NodeMap()
    facts[one] = 1
    facts[other] = 2
    assert (facts[one], facts[other]) == (1, 2)
    assert node() not in facts


def test_a_node_lives_as_long_as_the_facts_about_it() -> None:
    facts: NodeMap[int] = NodeMap()
    one = node()
    facts[one] = 1
    watched = weakref.ref(one.name)
    del one
    gc.collect()
    assert watched() is not None


def test_what_nothing_is_known_about_has_no_fact() -> None:
    facts: NodeMap[int] = NodeMap()
    assert facts.get(node()) is None
    with pytest.raises(AssertionError, match="nothing is known about `docked`"):
        facts[node()]
