"""ross.lark -> tables.json, the LALR tables that `automaton` runs on.

Run by `python -m rossmarie.syntax.generate` after a change of the grammar. Lark is needed here
only: reading the grammar and building the tables takes far longer than parsing a file.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from pathlib import Path

from lark import Lark
from lark.grammar import Rule

FOLDER = Path(__file__).parent
START_RULES = (
    "import_item",
    "system",
    "action",
    "constant",
    "input",
    "entity",
    "rule",
    "condition",
    "expression",
    "contract",
    "topic_declaration",
    "unit_declaration",
    "messages_declaration",
    "node",
)


def generate_tables() -> str:
    """The text of tables.json. Raises lark's `GrammarError` if the grammar is not LALR(1).

    `rules`: name, length and action (`pass`, `list` or `call METHOD`) of each rule. `states`: for
    each state, what to do on a symbol: `n >= 0` go to state n, `n < 0` reduce by rule `-n - 1`. A
    literal of the grammar stands for itself, every other symbol begins with `$`. The same grammar
    always gives the same text.
    """
    grammar = (FOLDER / "ross.lark").read_text(encoding="utf-8")
    lark = Lark(grammar, parser="lalr", start=list(START_RULES), maybe_placeholders=False)
    table = lark.parser.parser._parse_table  # noqa: SLF001 -- lark has no public way to its tables
    literals = {term.name: term.pattern.value for term in lark.terminals if term.pattern}
    shifts: dict[int, dict[str, int]] = {}
    reductions: dict[int, dict[str, Rule]] = {}
    for state, row in table.states.items():
        entries = {literals.get(name, f"${name.strip('$')}"): row[name] for name in sorted(row)}
        shifts[state] = {name: to for name, (do, to) in entries.items() if do.name == "Shift"}
        reductions[state] = {name: by for name, (do, by) in entries.items() if do.name == "Reduce"}
    order = _reachable([table.start_states[name] for name in START_RULES], shifts)
    rules = sorted({rule for row in reductions.values() for rule in row.values()}, key=_key)
    codes = {rule: -1 - number for number, rule in enumerate(rules)}
    numbers = {state: number for number, state in enumerate(order)}
    states = [
        {name: numbers[to] for name, to in shifts[state].items()}
        | {name: codes[rule] for name, rule in reductions[state].items()}
        for state in order
    ]
    sections = {
        "starts": [json.dumps({name: numbers[table.start_states[name]]}) for name in START_RULES],
        "ends": [json.dumps({name: numbers[table.end_states[name]]}) for name in START_RULES],
        "rules": [json.dumps(_describe(rule)) for rule in rules],
        "states": [json.dumps(state) for state in states],
    }
    return _lay_out(sections)


def _reachable(starts: Iterable[int], shifts: Mapping[int, Mapping[str, int]]) -> list[int]:
    """All states, nearest first: a numbering that depends on the grammar alone."""
    order = dict.fromkeys(starts)
    pending = list(order)
    for state in pending:
        for target in shifts[state].values():
            if target not in order:
                order[target] = None
                pending.append(target)
    return pending


def _key(rule: Rule) -> tuple[str, list[str]]:
    return (str(rule.origin.name), [str(symbol.name) for symbol in rule.expansion])


def _describe(rule: Rule) -> tuple[str, int, str]:
    name = str(rule.origin.name)
    length = len(rule.expansion)
    is_inlined = name.startswith("_")
    if length == 1 and (is_inlined or rule.options.expand1):
        return (name, length, "pass")
    if is_inlined:
        return (name, length, "list")
    return (name, length, f"call {rule.alias or name}")


def _lay_out(sections: Mapping[str, list[str]]) -> str:
    """JSON with an entry per line, so that a change of the grammar can be read."""
    texts = (f'"{name}": [\n' + ",\n".join(lines) + "\n]" for name, lines in sections.items())
    return "{\n" + ",\n".join(texts) + "\n}\n"


if __name__ == "__main__":
    (FOLDER / "tables.json").write_text(generate_tables(), encoding="utf-8")
