"""The tables of the parser, and a parser that goes through them token by token.

lark makes the tables from ross.lark, and says what is wrong with a grammar that is not LALR(1).
They are kept as JSON in the user's cache folder, so that a run does without lark.

A symbol is a literal of the grammar (`:`, `rule`) or a terminal behind a `$` (`$NAME`).
"""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

END = "$$END"
"""The symbol behind the last token."""


class Node(NamedTuple):
    """A rule of the grammar that was recognised; its parts are tokens and nodes."""

    rule: str
    parts: list[Any]


class Reduction(NamedTuple):
    """An expansion of a rule: how many symbols it has, and what is made of them. A rule that
    `is_spliced` gives its parts to the rule above it, one that `is_transparent` a single part.
    """

    origin: str
    size: int
    rule: str
    is_spliced: bool
    is_transparent: bool


State = tuple[Mapping[str, int], Mapping[str, int]]
"""The action on each symbol - go to a state, or, below zero, reduce by ~N -, and the state to go to
behind each rule.
"""


@dataclass(frozen=True)
class Tables:
    """The automaton: the first and the last state of each start rule, states, and reductions."""

    starts: Mapping[str, tuple[int, int]]
    states: tuple[State, ...]
    reductions: tuple[Reduction, ...]
    _accepted: dict[tuple[int, ...], frozenset[str]] = field(default_factory=dict, compare=False)

    @cached_property
    def ends(self) -> frozenset[int]:
        """The last states of all start rules."""
        return frozenset(last for _, last in self.starts.values())

    def accepted(self, stack: tuple[int, ...]) -> frozenset[str]:
        """The symbols that a parser takes that has gone through these states."""
        if stack not in self._accepted:
            known = self.states[stack[-1]][0]
            self._accepted[stack] = frozenset(each for each in known if self._takes(stack, each))
        return self._accepted[stack]

    def _takes(self, stack: tuple[int, ...], symbol: str) -> bool:
        parser = Parser(self, stack)
        return parser.feed(symbol, None) if symbol != END else parser.end() is not None


class Parser:
    """Takes the tokens of one stretch. What it recognises it keeps as nodes, until the end."""

    def __init__(self, tables: Tables, stack: tuple[int, ...]) -> None:
        self.tables = tables
        self._stack = list(stack)
        self._values: list[Any] = [None] * (len(stack) - 1)

    @property
    def stack(self) -> tuple[int, ...]:
        """The states that it has gone through."""
        return tuple(self._stack)

    @property
    def fitting(self) -> Collection[str]:
        """The symbols that it may be able to take; what it has gone through decides."""
        return self.tables.states[self._stack[-1]][0].keys()

    def feed(self, symbol: str, token: object) -> bool:
        """Say whether the token fits as that symbol; the parser has then taken it."""
        states, stack = self.tables.states, self._stack
        while True:
            action = states[stack[-1]][0].get(symbol)
            if action is None:
                return False
            if action >= 0:
                stack.append(action)
                self._values.append(token)
                return True
            self._reduce(self.tables.reductions[~action])

    def end(self) -> list[Any] | None:
        """The value of the whole stretch, alone in a list; None if something is missing."""
        states, ends = self.tables.states, self.tables.ends
        while True:
            action = states[self._stack[-1]][0].get(END)
            if action is None:
                return None
            self._reduce(self.tables.reductions[~action])
            if self._stack[-1] in ends:
                return self._values[-1:]

    def _reduce(self, reduction: Reduction) -> None:
        parts: list[Any] = []
        if reduction.size:
            for value in self._values[-reduction.size :]:
                parts += value if isinstance(value, list) else (value,)
            del self._values[-reduction.size :]
            del self._stack[-reduction.size :]
        if reduction.is_spliced:
            self._values.append(parts)
        elif reduction.is_transparent and len(parts) == 1:
            self._values.append(parts[0])
        else:
            self._values.append(Node(reduction.rule, parts))
        self._stack.append(self.tables.states[self._stack[-1]][1][reduction.origin])


# --- made by lark, and kept --------------------------------------------------------------------


def make_tables(grammar: str, start_rules: Collection[str]) -> bytes:
    """The tables of a grammar, to be kept. Raises lark's `GrammarError` if it is not LALR(1)."""
    from lark import Lark

    built: Any = Lark(
        grammar,
        parser="lalr",
        start=list(start_rules),
        keep_all_tokens=True,
        maybe_placeholders=False,
    )
    table = built.parser.parser._parse_table  # noqa: SLF001 - lark shows it nowhere else
    symbols = {term.name: str(term.pattern.value) for term in built.terminals}
    reductions = list(dict.fromkeys(_reductions(table)))
    numbers = {rule: number for number, rule in enumerate(reductions)}
    content = {
        "starts": {
            start: [table.start_states[start], table.end_states[start]] for start in start_rules
        },
        "states": [
            _state(table.states[number], symbols, numbers) for number in sorted(table.states)
        ],
        "reductions": [_reduction(rule) for rule in reductions],
    }
    return json.dumps(content).encode()


def read_tables(content: bytes) -> Tables:
    """The tables that `make_tables` made."""
    read = json.loads(content)
    return Tables(
        {start: (first, last) for start, (first, last) in read["starts"].items()},
        tuple((actions, gotos) for actions, gotos in read["states"]),
        tuple(Reduction(*each) for each in read["reductions"]),
    )


def _reductions(table: Any) -> Iterator[Any]:
    for state in table.states.values():
        yield from (rule for action, rule in state.values() if action.name == "Reduce")


def _state(
    state: Mapping[str, Any], symbols: Mapping[str, str], numbers: Mapping[Any, int]
) -> list[dict[str, int]]:
    actions: dict[str, int] = {}
    gotos: dict[str, int] = {}
    for name, (action, argument) in state.items():
        if not name.isupper():
            gotos[name] = argument
        else:
            is_shift = action.name == "Shift"
            actions[symbols.get(name, f"${name}")] = argument if is_shift else ~numbers[argument]
    return [actions, gotos]


def _reduction(rule: Any) -> tuple[str, int, str, bool, bool]:
    origin = str(rule.origin.name)
    is_transparent = bool(rule.options.expand1) and rule.alias is None
    is_spliced = origin.startswith("_")
    return origin, len(rule.expansion), rule.alias or origin, is_spliced, is_transparent
