"""Texts of the generated C about its rules, for its users."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rossmarie.targets import comments
from rossmarie.targets.c99 import names
from rossmarie.targets.c99.layout import CLayout
from rossmarie.targets.c99.text import indented


def most(counts: Iterable[int]) -> int:
    """The greatest count, at least one: C has no empty arrays."""
    return max(1, *counts, 1)


def rule_enumeration(layout: CLayout) -> str:
    """The public names of the rules."""
    rules = layout.machine.rules
    if not rules:
        return ""
    rows = [
        f"    {layout.name}_{name} = {index}, /* {comments.in_c(_remark(layout, index))} */"
        for index, name in enumerate(layout.rule_names)
    ]
    body = "\n".join(rows)
    body = body.replace(f" = {len(rules) - 1}, /*", f" = {len(rules) - 1} /*")
    return f"enum {layout.name}_rule {{\n{body}\n}};\n"


def text_declaration(layout: CLayout) -> str:
    """The texts that rules compare with, for programs that give texts to a monitor."""
    texts = layout.machine.texts
    if not texts:
        return ""
    return (
        "/* The texts that rules compare. Pass a text of a message as its index in this table, or\n"
        " * as -1 if the table does not contain the text.\n */\n"
        f"extern const char *const {layout.name}_texts[{len(texts)}];\n\n"
    )


def descriptions(layout: CLayout) -> str:
    """The tables with the texts of each rule, and of compared texts."""
    machine = layout.machine
    propositions = [proposition.name or proposition.text for proposition in machine.propositions]
    terms = [[propositions[index] for index in rule.terms] for rule in machine.rules]
    values = [[machine.signals[index].text for index in rule.signals] for rule in machine.rules]
    inputs = [[machine.inputs[index].name for index in rule.inputs] for rule in machine.rules]
    named = [rule.name for rule in machine.rules]
    parts = [
        _texts("static const char *const term_texts", named, terms),
        _texts("static const char *const value_texts", named, values),
        _texts("static const char *const input_texts", named, inputs),
        _rules(layout),
    ]
    if machine.texts:
        parts.append(_texts(f"const char *const {layout.name}_texts", ["texts"], [machine.texts]))
    return "\n".join(parts)


def _texts(declared: str, named: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table of texts. The texts of rule i are adjacent; other tables give their numbers."""
    quoted = [
        f"/* {comments.in_c(name)} */ {', '.join(map(names.string, row))},"
        for name, row in zip(named, rows, strict=True)
        if row
    ] or ['""']
    count = max(1, sum(map(len, rows)))
    return f"{declared}[{count}] = {{\n{indented(quoted)}\n}};"


def _rules(layout: CLayout) -> str:
    rows, starts = [], [0, 0, 0]
    for rule in layout.machine.rules:
        texts = (
            rule.name,
            layout.machine.propositions[rule.condition].text,
            rule.contract,
            " ".join(rule.actions),
            names.place(rule.span),
        )
        quoted = [names.string(text) for text in texts]
        tables = zip(("term", "value", "input"), starts, strict=True)
        behind = ", ".join(f"{kind}_texts + {start}" for kind, start in tables)
        counts = [len(rule.terms), len(rule.signals), len(rule.inputs)]
        starts = [start + count for start, count in zip(starts, counts, strict=True)]
        listed = ", ".join(map(str, counts))
        rows.append(f"    {{{quoted[0]}, {quoted[1]},")
        rows.append(f"     {quoted[2]},")
        rows.append(f"     {quoted[3]}, {quoted[4]}, {behind}, {listed}}},")
    empty = '    {"", "", "", "", "", term_texts, value_texts, input_texts, 0, 0, 0},'
    body = "\n".join(rows) or empty
    declared = f"const {layout.name}_description {layout.name}_rules"
    return f"{declared}[{max(1, len(layout.machine.rules))}] = {{\n{body}\n}};"


def _remark(layout: CLayout, index: int) -> str:
    rule = layout.machine.rules[index]
    return f"{names.place(rule.span)}  {rule.contract}"
