"""The grammar and the builder fit together."""

from __future__ import annotations

from rossmarie.syntax.build import Builder
from rossmarie.syntax.grammar import load_tables


def test_every_rule_of_the_grammar_has_its_method() -> None:
    methods = {
        each.rule
        for each in load_tables().reductions
        if not each.is_spliced and not (each.is_transparent and each.size == 1)
    }
    assert {"rule", "held", "latched_until_reset"} <= methods
    assert {method for method in methods if not hasattr(Builder, method)} == set()
