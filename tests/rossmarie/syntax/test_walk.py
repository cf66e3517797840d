"""Walking over expressions."""

from __future__ import annotations

from collections.abc import Callable

from rossmarie.syntax import ast, walk
from rossmarie.syntax.walk import depth, expressions


def test_walk_visits_everything_in_the_order_of_the_text(
    accepted: Callable[[str], ast.Module],
) -> None:
    text = "a.b[0] in [c, -d] m and not (e > f(g)) for h or oscillates(i, 2 times, within j, by k)"
    (entity,) = accepted(f"entity n {{ m : {text}; }}").items
    (root,) = expressions(entity)
    visited = list(walk(root))
    references = [node.name.text for node in visited if isinstance(node, ast.Reference)]
    assert references == list("acdeghijk")
    assert visited[0] is root
    assert [type(node).__name__ for node in visited if not isinstance(node, ast.Reference)] == [
        "Binary",
        "Binary",
        "Membership",
        "Index",
        "Member",
        "Bracket",
        "Unary",
        "Held",
        "Unary",
        "Parenthesized",
        "Binary",
        "Call",
        "Oscillates",
        "Number",
    ]


def test_expressions_of_each_item(accepted: Callable[[str], ast.Module]) -> None:
    module = accepted(
        "action a; const c = b input i = topic t timeout d input j = topic t\n"
        "entity e { x : f; y : g; } if h then {} clear when k clear for l latched until reset"
    )
    found = [[root.span.text for root in expressions(item)] for item in module.items]
    assert found == [[], ["b"], ["d"], [], ["f", "g"], ["h", "k", "l"]]


def test_depth_counts_levels(accepted: Callable[[str], ast.Module]) -> None:
    for text, levels in (("a", 1), ("-a", 2), ("a + b + c", 3), ("(a)", 2), ("f(a, -b)", 3)):
        (constant,) = accepted(f"const x = {text}").items
        assert isinstance(constant, ast.Constant)
        assert depth(constant.value) == levels
