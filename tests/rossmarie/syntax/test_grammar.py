"""The grammar and the builder fit together."""

from __future__ import annotations

from rossmarie.syntax.build import Builder
from rossmarie.syntax.grammar import load_grammar


def test_every_rule_of_the_grammar_has_its_method() -> None:
    methods = {
        rule.alias or str(rule.origin.name)
        for rule in load_grammar().lark.rules
        if not str(rule.origin.name).startswith("_")
        and not (rule.options.expand1 and len(rule.expansion) == 1 and rule.alias is None)
    }
    assert {"rule", "held", "latched_until_reset"} <= methods
    assert {method for method in methods if not hasattr(Builder, method)} == set()
