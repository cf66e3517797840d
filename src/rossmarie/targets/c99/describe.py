"""What the generated C says of its rules to whoever runs it."""

from __future__ import annotations

from collections.abc import Iterable

from rossmarie.targets.c99 import names
from rossmarie.targets.c99.layout import Layout


def most(counts: Iterable[int]) -> int:
    """The greatest count, at least one: C has no empty arrays."""
    return max(1, *counts, 1)


def rule_enumeration(layout: Layout) -> str:
    """The public names of the rules."""
    rules = layout.machine.rules
    if not rules:
        return ""
    rows = [
        f"    {layout.name}_{name} = {index}, /* {names.comment(_remark(layout, index))} */"
        for index, name in enumerate(layout.rule_names)
    ]
    body = "\n".join(rows)
    body = body.replace(f" = {len(rules) - 1}, /*", f" = {len(rules) - 1} /*")
    return f"enum {layout.name}_rule {{\n{body}\n}};\n"


def descriptions(layout: Layout) -> str:
    """The table of what each rule says."""
    rows = []
    for rule in layout.machine.rules:
        texts = (
            rule.name,
            layout.machine.truths[rule.condition].text,
            rule.contract,
            " ".join(rule.actions),
            names.place(rule.span),
        )
        quoted = ",\n     ".join(names.string(text) for text in texts)
        counts = f"{len(rule.terms)}, {len(rule.signals)}, {len(rule.inputs)}"
        rows.append(f"    {{{quoted},\n     {counts}}},")
    body = "\n".join(rows) or '    {"", "", "", "", "", 0, 0, 0},'
    kind = f"{layout.name}_description"
    return f"const {kind} {layout.name}_rules[{max(1, len(rows))}] = {{\n{body}\n}};"


def _remark(layout: Layout, index: int) -> str:
    rule = layout.machine.rules[index]
    return f"{names.place(rule.span)}  {rule.contract}"
