"""Loops over arrays: one pass for all that is asked of the elements of one array.

Takes a layout and the expressions of its machine; gives statements. Elementwise nodes use one
array and constants only.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from rossmarie import ir
from rossmarie.targets.c99.expressions import Expressions, converted
from rossmarie.targets.c99.layout import Layout

_START = {ir.Folding.MINIMUM: "INFINITY", ir.Folding.MAXIMUM: "-INFINITY"}
_CALLS = {ir.Quantifier.ANY: "some", ir.Quantifier.ALL: "every"}


@dataclass
class _Loop:
    """The statements before, in and after the loop over an array, and the locals it has; these are
    in capitals, so that no field of a message is named like one.
    """

    before: list[str] = field(default_factory=list)
    inside: list[str] = field(default_factory=list)
    after: list[str] = field(default_factory=list)
    signals: dict[int, str] = field(default_factory=dict)
    truths: dict[int, str] = field(default_factory=dict)
    counted: set[int] = field(default_factory=set)


class Elements:
    """Writes the loops of one machine."""

    def __init__(self, layout: Layout, expressions: Expressions) -> None:
        self._layout = layout
        self._machine = layout.machine
        self._expressions = expressions

    def loop(self, array: int, pointer: str, count: str) -> list[str]:
        """All that is computed from the elements of an array; nothing if nothing is."""
        loop = _Loop()
        for index, signal in enumerate(self._machine.signals):
            match signal.node:
                case ir.Fold(element=element) if self._layout.elements.signals[element] == array:
                    self._fold(loop, index, signal.node, pointer, count)
                case ir.Count(element=element) if self._layout.elements.truths[element] == array:
                    self._counted(loop, element, pointer)
                    self._finish(loop, self._layout.value_of_signal[index], "how_many", element,
                                 count)  # fmt: skip
                case (
                    ir.Constant() | ir.Read() | ir.Apply() | ir.Sampled()
                    | ir.Element() | ir.Fold() | ir.Count()
                ):  # fmt: skip
                    pass
        for index, node in self._quantified(array):
            call = _CALLS[node.quantifier]
            self._counted(loop, node.element, pointer)
            self._finish(loop, self._layout.value_of_test[index], call, node.element, count)
        return _written(loop, count)

    def _quantified(self, array: int) -> Iterator[tuple[int, ir.Quantified]]:
        for index in self._layout.value_of_test:
            node = self._machine.truths[index].node
            if not isinstance(node, ir.Quantified):
                continue
            if self._layout.elements.truths[node.element] == array:
                yield index, node

    # --- results -----------------------------------------------------------------------------

    def _fold(self, loop: _Loop, index: int, node: ir.Fold, pointer: str, count: str) -> None:
        name = f"{node.folding.value.upper()}_{index}"
        loop.before.append(f"double {name} = {_START[node.folding]};")
        element = self._signal(loop, node.element, pointer)
        folded = self._expressions.called(node.folding.function, [name, element])
        loop.inside.append(f"{name} = {folded};")
        target = self._expressions.kept(self._layout.value_of_signal[index])
        loop.after.append(f"{target} = {count} != 0 ? {name} : NAN;")

    def _counted(self, loop: _Loop, element: int, pointer: str) -> None:
        """Count for how many elements a truth holds and is unknown."""
        if element in loop.counted:
            return
        loop.counted.add(element)
        loop.before.append(f"size_t TRUTHS_{element} = 0, UNKNOWNS_{element} = 0;")
        truth = self._truth(loop, element, pointer)
        loop.inside.append(f"TRUTHS_{element} += {truth} == TRUE;")
        loop.inside.append(f"UNKNOWNS_{element} += {truth} == UNKNOWN;")

    def _finish(self, loop: _Loop, value: int, call: str, element: int, count: str) -> None:
        target = self._expressions.kept(value)
        arguments = f"TRUTHS_{element}, UNKNOWNS_{element}, {count}"
        loop.after.append(f"{target} = {call}({arguments});")

    # --- one element -------------------------------------------------------------------------

    def _signal(self, loop: _Loop, index: int, pointer: str) -> str:
        """The number of the element at hand, as a local computed once."""
        if self._layout.elements.signals[index] is None:
            return self._expressions.operand(index)
        if index not in loop.signals:
            node = self._machine.signals[index].node
            if isinstance(node, ir.Element):
                array = self._machine.arrays[node.array]
                text = converted(f"{pointer}[i]", array.scale, array.offset)
            else:
                assert isinstance(node, ir.Apply), "verified: nothing else is elementwise"
                text = self._expressions.applied(
                    node, lambda operand: self._signal(loop, operand, pointer)
                )
            loop.signals[index] = f"ELEMENT_{index}"
            loop.inside.append(f"const double ELEMENT_{index} = {text};")
        return loop.signals[index]

    def _truth(self, loop: _Loop, index: int, pointer: str) -> str:
        if index not in loop.truths:
            text = self._truth_text(loop, index, pointer)
            loop.truths[index] = f"IS_{index}"
            loop.inside.append(f"const unsigned char IS_{index} = {text};")
        return loop.truths[index]

    def _truth_text(self, loop: _Loop, index: int, pointer: str) -> str:
        match self._machine.truths[index].node:
            case ir.Literal(value=value):
                return "TRUE" if value else "FALSE"
            case ir.Not(operand=operand):
                return f"opposite({self._truth(loop, operand, pointer)})"
            case ir.And(operands=operands):
                return self._joined("both", loop, operands, pointer)
            case ir.Or(operands=operands):
                return self._joined("either", loop, operands, pointer)
            case (
                ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches() | ir.Oscillates()
                | ir.Quantified() | ir.Held() | ir.Since() | ir.Recurs()
            ) as node:  # fmt: skip
                write = lambda signal: self._signal(loop, signal, pointer)  # noqa: E731
                is_unknown, holds = self._expressions.comparison(node, write)
                return f"element_truth({is_unknown}, {holds})"

    def _joined(self, word: str, loop: _Loop, operands: tuple[int, ...], pointer: str) -> str:
        text = self._truth(loop, operands[0], pointer)
        for operand in operands[1:]:
            text = f"{word}({text}, {self._truth(loop, operand, pointer)})"
        return text


def _written(loop: _Loop, count: str) -> list[str]:
    if not loop.after:
        return []
    return [
        "{",
        *(f"    {line}" for line in loop.before),
        f"    for (size_t i = 0; i != {count}; i++) {{",
        *(f"        {line}" for line in loop.inside),
        "    }",
        *(f"    {line}" for line in loop.after),
        "}",
    ]
