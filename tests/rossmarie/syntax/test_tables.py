"""The parser that goes through kept tables does what lark's own does, step by step."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import lark
from hypothesis import given, settings
from hypothesis import strategies as st

import rossmarie.syntax
from rossmarie.syntax.grammar import START_RULES, load_tables
from rossmarie.syntax.tables import END, GrammarNode, Parser, Tables
from support.depth import examples

GRAMMAR = Path(rossmarie.syntax.__file__).with_name("ross.lark")
_MOST_TOKENS = 40


@cache
def lark_itself() -> lark.Lark:
    return lark.Lark(
        GRAMMAR.read_text(encoding="utf-8"),
        parser="lalr",
        start=list(START_RULES),
        keep_all_tokens=True,
        maybe_placeholders=False,
    )


@cache
def terminals() -> dict[str, str]:
    """Lark's name of each symbol."""
    named = {str(term.pattern.value): term.name for term in lark_itself().terminals}
    return named | {END: "$END"}


def name_of(symbol: str) -> str:
    return terminals().get(symbol, symbol.removeprefix("$"))


def accepted(theirs: Any) -> set[str]:
    return {name for name in theirs.accepts() if name.isupper()}


def shown(part: Any) -> object:
    """A tree as lists, whoever made it."""
    if isinstance(part, GrammarNode):
        return [part.rule, *map(shown, part.parts)]
    if isinstance(part, lark.Tree):
        return [str(part.data), *map(shown, part.children)]
    return str(part)


@settings(max_examples=examples(20), deadline=None)
@given(st.data())
def test_both_take_the_same_tokens_and_see_the_same_rules(data: st.DataObject) -> None:
    tables: Tables = load_tables()
    start = data.draw(st.sampled_from(START_RULES))
    parser = Parser(tables, tables.starts[start][:1])
    theirs: Any = lark_itself().parse_interactive(start=start)
    symbols = sorted(terminals())
    for index in range(data.draw(st.integers(0, _MOST_TOKENS))):
        known = sorted(tables.accepted(parser.stack))
        assert {name_of(symbol) for symbol in known} == accepted(theirs)
        fitting = [symbol for symbol in known if symbol != END]
        is_wild = not fitting or data.draw(st.integers(0, 30)) == 0
        symbol = data.draw(st.sampled_from(symbols if is_wild else fitting))
        if symbol == END:
            break
        took = parser.feed(symbol, f"token{index}")
        try:
            theirs.feed_token(lark.Token(name_of(symbol), f"token{index}"))
        except lark.UnexpectedToken:
            assert not took
            assert {name_of(each) for each in tables.accepted(parser.stack)} == accepted(theirs)
            return
        assert took
    found = parser.end()
    try:
        expected = theirs.feed_eof()
    except lark.UnexpectedToken:
        assert found is None
        return
    assert found is not None
    assert shown(found[0]) == shown(expected)
