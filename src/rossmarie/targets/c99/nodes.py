"""Propositions that are evaluated when marked, as C: combinations of other propositions, and
oscillations.
"""

from __future__ import annotations

from rossmarie import ir
from rossmarie.targets import comments
from rossmarie.targets.c99 import names
from rossmarie.targets.c99.layout import CLayout


def derive(layout: CLayout) -> str:
    """The function that evaluates one derived proposition. The declaration of its name contains the
    proposition's text.
    """
    marked = (*layout.oscillations, *layout.derived)
    cases = []
    for index in marked:
        proposition = layout.machine.propositions[index]
        value = _expression(layout, index, proposition.node)
        place = comments.in_c(names.place(proposition.span))
        cases.append(f"    case {layout.proposition_names[index]}: return {value}; /* {place} */")
    unused = [] if marked else ["    (void)m;"]
    unused += [] if layout.held or layout.recent else ["    (void)t_ns;"]
    lines = [
        "static unsigned char derive(monitor *m, unsigned node, int64_t t_ns)",
        "{",
        *unused,
        "    switch (node) {",
        *cases,
        "    default: return UNKNOWN;",
        "    }",
        "}\n",
    ]
    return "\n".join(lines)


def _expression(layout: CLayout, index: int, node: ir.PropositionNode) -> str:
    match node:
        case ir.Not(operand=operand):
            return f"opposite({_proposition(layout, operand)})"
        case ir.And(operands=operands):
            return _joined(layout, "both", operands)
        case ir.Or(operands=operands):
            return _joined(layout, "either", operands)
        case ir.Oscillates():
            return f"swings_or_gap(m, {layout.oscillations.index(index)}, t_ns)"
        case ir.Recurs(operand=operand):
            number = layout.recurring.index(index)
            return f"recurs(m, {number}, {layout.proposition_names[operand]}, t_ns)"
        case ir.Held(operand=operand):
            number = layout.held.index(index)
            return f"held(m, {number}, {layout.proposition_names[operand]}, t_ns)"
        case ir.Since(held=held, begun=begun):
            number = layout.sinces.index(index)
            sides = f"{layout.proposition_names[held]}, {layout.proposition_names[begun]}"
            return f"since(m, {number}, {sides})"
        case (
            ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches()
            | ir.Quantified()
        ):  # fmt: skip
            raise AssertionError(f"{type(node).__name__} is a leaf")


def _joined(layout: CLayout, word: str, operands: tuple[int, ...]) -> str:
    text = _proposition(layout, operands[0])
    for operand in operands[1:]:
        text = f"{word}({text}, {_proposition(layout, operand)})"
    return text


def _proposition(layout: CLayout, index: int) -> str:
    return f"m->truth_value[{layout.proposition_names[index]}]"
