"""The tables of the parser, and a parser that applies them token by token.

lark computes the tables from ross.lark, and reports a grammar that is not LALR(1). They are stored
as JSON in the user's cache folder, so that a run does not need lark.

A symbol is a literal of the grammar (`:`, `rule`) or a terminal with a `$` (`$NAME`).
"""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

END = "$$END"
"""The symbol after the last token."""


class GrammarNode(NamedTuple):
    """A recognised rule of the grammar. Its parts are tokens and nodes."""

    rule: str
    parts: list[Any]


class Reduction(NamedTuple):
    """An expansion of a rule: its number of symbols, and the node that it creates. A rule that
    `is_spliced` passes its parts to the rule above it. A rule that `is_transparent` passes on a
    single part.
    """

    origin: str
    size: int
    rule: str
    is_spliced: bool
    is_transparent: bool


State = tuple[Mapping[str, int], Mapping[str, int]]
"""The action on each symbol, and the next state after each rule. An action is the next state or, if
negative, a reduction ~N.
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
        """The symbols that a parser with this stack of states accepts."""
        if stack not in self._accepted:
            known = self.states[stack[-1]][0]
            self._accepted[stack] = frozenset(each for each in known if self._takes(stack, each))
        return self._accepted[stack]

    def _takes(self, stack: tuple[int, ...], symbol: str) -> bool:
        parser = Parser(self, stack)
        return parser.feed(symbol, None) if symbol != END else parser.end() is not None


class Parser:
    """Reads the tokens of one range. The recognised nodes are kept until the end."""

    def __init__(self, tables: Tables, stack: tuple[int, ...]) -> None:
        self.tables = tables
        self._stack = list(stack)
        self._values: list[Any] = [None] * (len(stack) - 1)

    @property
    def stack(self) -> tuple[int, ...]:
        """The stack of states."""
        return tuple(self._stack)

    @property
    def fitting(self) -> Collection[str]:
        """The symbols that may be accepted. The stack decides whether they are."""
        return self.tables.states[self._stack[-1]][0].keys()

    def feed(self, symbol: str, token: object) -> bool:
        """Read a token as a symbol. Returns False if it does not fit."""
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
        """The value of the whole range, alone in a list; None if tokens are missing."""
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
            self._values.append(GrammarNode(reduction.rule, parts))
        self._stack.append(self.tables.states[self._stack[-1]][1][reduction.origin])


# --- computing and storing tables --------------------------------------------------------


def make_tables(grammar: str, start_rules: Collection[str]) -> bytes:
    """The tables of a grammar, for storing. Raises lark's `GrammarError` if it is not LALR(1)."""
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
    """The tables in a result of `make_tables`."""
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
