"""Loops over arrays and lists: one pass computes all results over the elements of an array or list.

The input is a layout and the expressions of its machine; the result is statements. Elementwise
nodes use one array, or columns of one list, and numbers that are known before.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from rossmarie import ir
from rossmarie.targets.c99.expressions import Expressions, converted
from rossmarie.targets.c99.layout import CLayout

_START = {ir.Folding.MINIMUM: "INFINITY", ir.Folding.MAXIMUM: "-INFINITY"}
_CALLS = {ir.Quantifier.ANY: "some", ir.Quantifier.ALL: "every"}


@dataclass
class _Loop:
    """The statements before, in and after the loop over an array or a list, and its local
    variables. Local variables are in capitals, so that no field of a message has the same name.
    `columns` are the parameters by array; `count` is the number of elements; `most` is the bound of
    a list.
    """

    columns: Mapping[int, str]
    count: str
    most: int | None
    before: list[str] = field(default_factory=list)
    inside: list[str] = field(default_factory=list)
    after: list[str] = field(default_factory=list)
    signals: dict[int, str] = field(default_factory=dict)
    propositions: dict[int, str] = field(default_factory=dict)
    counted: set[int] = field(default_factory=set)

    def known(self, number: str) -> str:
        """A number that is unknown if the elements give no result: an array without elements, or a
        list with too many.
        """
        condition = f"{self.count} != 0" if self.most is None else "IS_KNOWN"
        return f"{condition} ? {number} : NAN"

    @property
    def end(self) -> str:
        """The number of elements in the loop."""
        return self.count if self.most is None else "ELEMENTS"


class ElementLoops:
    """Writes the loops of one machine."""

    def __init__(self, layout: CLayout, expressions: Expressions) -> None:
        self._layout = layout
        self._machine = layout.machine
        self._expressions = expressions

    def loop(self, columns: Mapping[int, str], count: str) -> list[str]:
        """The statements that compute all results over the elements of an array, or of a list with
        these columns; empty if there are no results. `columns` are the parameters.
        """
        first = min(columns)
        its_list = self._machine.arrays[first].list
        most = None if its_list is None else self._machine.lists[its_list].most
        loop = _Loop(columns, count, most)
        for index, signal in enumerate(self._machine.signals):
            match signal.node:
                case ir.Fold(element=element) if self._layout.elements.signals[element] == first:
                    self._fold(loop, index, signal.node)
                case ir.Count(element=element) if (
                    self._layout.elements.propositions[element] == first
                ):
                    self._counted(loop, element)
                    value = self._layout.value_of_signal[index]
                    self._finish(loop, value, "how_many", element)
                case (
                    ir.Constant() | ir.Read() | ir.Apply() | ir.Sampled()
                    | ir.Element() | ir.Fold() | ir.Count()
                ):  # fmt: skip
                    pass
        for index, node in self._quantified(first):
            self._counted(loop, node.element)
            self._finish(
                loop, self._layout.value_of_test[index], _CALLS[node.quantifier], node.element
            )
        return _written(loop)

    def _quantified(self, array: int) -> Iterator[tuple[int, ir.Quantified]]:
        for index in self._layout.value_of_test:
            node = self._machine.propositions[index].node
            if not isinstance(node, ir.Quantified):
                continue
            if self._layout.elements.propositions[node.element] == array:
                yield index, node

    # --- results -----------------------------------------------------------------------------

    def _fold(self, loop: _Loop, index: int, node: ir.Fold) -> None:
        name = f"{node.folding.value.upper()}_{index}"
        loop.before.append(f"double {name} = {_START[node.folding]};")
        element = self._signal(loop, node.element)
        folded = self._expressions.called(node.folding.function, [name, element])
        loop.inside.append(f"{name} = {folded};")
        target = self._expressions.kept(self._layout.value_of_signal[index])
        loop.after.append(f"{target} = {loop.known(name)};")

    def _counted(self, loop: _Loop, element: int) -> None:
        """Count the elements for which a proposition is true, and for which it is unknown."""
        if element in loop.counted:
            return
        loop.counted.add(element)
        loop.before.append(f"size_t PROPOSITIONS_{element} = 0, UNKNOWNS_{element} = 0;")
        proposition = self._proposition(loop, element)
        loop.inside.append(f"PROPOSITIONS_{element} += {proposition} == TRUE;")
        loop.inside.append(f"UNKNOWNS_{element} += {proposition} == UNKNOWN;")

    def _finish(self, loop: _Loop, value: int, call: str, element: int) -> None:
        target = self._expressions.kept(value)
        arguments = [f"PROPOSITIONS_{element}", f"UNKNOWNS_{element}"]
        if loop.most is None:
            arguments.append(loop.count)
        else:
            arguments += ["ELEMENTS", "IS_KNOWN"] if call == "every" else ["IS_KNOWN"]
            call = f"{call}_of_list"
        loop.after.append(f"{target} = {call}({', '.join(arguments)});")

    # --- one element -------------------------------------------------------------------------

    def _signal(self, loop: _Loop, index: int) -> str:
        """The number of the current element, as a local variable that is computed once."""
        if self._layout.elements.signals[index] is None:
            return self._beside(loop, index)
        if index not in loop.signals:
            node = self._machine.signals[index].node
            if isinstance(node, ir.Element):
                array = self._machine.arrays[node.array]
                text = converted(f"{loop.columns[node.array]}[i]", array.scale, array.offset)
            else:
                assert isinstance(node, ir.Apply), "verified: nothing else is elementwise"
                text = self._expressions.applied(node, lambda operand: self._signal(loop, operand))
            loop.signals[index] = f"ELEMENT_{index}"
            loop.inside.append(f"const double ELEMENT_{index} = {text};")
        return loop.signals[index]

    def _beside(self, loop: _Loop, index: int) -> str:
        """A number that is used beside the elements (S74), as a local variable."""
        if isinstance(self._machine.signals[index].node, ir.Constant):
            return self._expressions.operand(index)
        if index not in loop.signals:
            loop.signals[index] = f"BESIDE_{index}"
            kept = self._expressions.operand(index)
            loop.before.append(f"const double BESIDE_{index} = {kept};")
        return loop.signals[index]

    def _proposition(self, loop: _Loop, index: int) -> str:
        if index not in loop.propositions:
            text = self._proposition_text(loop, index)
            loop.propositions[index] = f"IS_{index}"
            loop.inside.append(f"const unsigned char IS_{index} = {text};")
        return loop.propositions[index]

    def _proposition_text(self, loop: _Loop, index: int) -> str:
        match self._machine.propositions[index].node:
            case ir.Literal(value=value):
                return "TRUE" if value else "FALSE"
            case ir.Not(operand=operand):
                return f"opposite({self._proposition(loop, operand)})"
            case ir.And(operands=operands):
                return self._joined("both", loop, operands)
            case ir.Or(operands=operands):
                return self._joined("either", loop, operands)
            case (
                ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches() | ir.Oscillates()
                | ir.Quantified() | ir.Held() | ir.Since() | ir.Recurs()
            ) as node:  # fmt: skip
                write = lambda signal: self._signal(loop, signal)  # noqa: E731
                is_unknown, holds = self._expressions.comparison(node, write)
                return f"element_proposition({is_unknown}, {holds})"

    def _joined(self, word: str, loop: _Loop, operands: tuple[int, ...]) -> str:
        text = self._proposition(loop, operands[0])
        for operand in operands[1:]:
            text = f"{word}({text}, {self._proposition(loop, operand)})"
        return text


def _written(loop: _Loop) -> list[str]:
    if not loop.after:
        return []
    known = []
    if loop.most is not None:
        known = [
            f"const bool IS_KNOWN = {loop.count} <= {loop.most};",
            f"const size_t ELEMENTS = IS_KNOWN ? {loop.count} : 0;",
        ]
    return [
        "{",
        *(f"    {line}" for line in (*known, *loop.before)),
        f"    for (size_t i = 0; i != {loop.end}; i++) {{",
        *(f"        {line}" for line in loop.inside),
        "    }",
        *(f"    {line}" for line in loop.after),
        "}",
    ]
