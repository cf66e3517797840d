"""The tables that the parser runs on come from the grammar next to them."""

from __future__ import annotations

from rossmarie.syntax.build import Builder
from rossmarie.syntax.generate import FOLDER, generate_tables


def test_the_tables_are_those_of_the_grammar() -> None:
    written = (FOLDER / "tables.json").read_text(encoding="utf-8")
    assert written == generate_tables(), "run: python -m rossmarie.syntax.generate"


def test_every_rule_of_the_grammar_has_its_method() -> None:
    actions = (line.split('"call ')[1] for line in generate_tables().split("\n") if "call " in line)
    methods = {action.split('"')[0] for action in actions}
    assert {method for method in methods if not hasattr(Builder, method)} == set()
    assert {"rule", "held", "latched_until_reset"} <= methods
