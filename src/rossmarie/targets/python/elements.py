"""Functions over the elements of an array or a list: one pass for all results over them (S22 to
S26, S51 to S54), also with numbers beside the elements, which are known before (S74).

The input is a layout. The results stay until the next message or the expiry of their input.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rossmarie import ir
from rossmarie.targets.formulas import definition_of
from rossmarie.targets.python import expressions
from rossmarie.targets.python.function import StartFunction
from rossmarie.targets.python.functions import PYTHON
from rossmarie.targets.python.layout import PythonLayout, number

_STARTS = {ir.Folding.MINIMUM: "INF", ir.Folding.MAXIMUM: "-INF"}


def results(layout: PythonLayout, array: int) -> dict[str, str]:
    """The variables that depend on an array, with their values without elements."""
    return {
        **{f"s{signal}": "NAN" for signal in (*_folds(layout, array), *_counts(layout, array))},
        **{f"q{proposition}": "2" for proposition in _quantifiers(layout, array)},
    }


def inputs_of(layout: PythonLayout, variable: str) -> frozenset[int]:
    """The inputs that such a variable depends on: those of the elements, and of numbers beside
    them.
    """
    supports = layout.supports.signals if variable[0] == "s" else layout.supports.propositions
    return supports[int(variable[1:])].inputs


def look(layout: PythonLayout, array: int) -> list[str]:
    """The function that processes the elements of an array, or of the list with this first column;
    empty for other columns.
    """
    columns = layout.beside(array)
    if array != columns[0]:
        return []
    function = StartFunction(
        f"look_{array}({', '.join(_elements(layout, column) for column in columns)})"
    )
    if not results(layout, array):
        return function.text()
    for variable, unknown in results(layout, array).items():
        function.assign(variable, unknown)
    function.line(f"if {_is_unknown(layout, array)}:")
    function.line("return", 1)
    folds, counted = _folds(layout, array), _counted(layout, array)
    for signal, node in folds.items():
        function.line(f"f{signal} = {_STARTS[node.folding]}")
    for proposition in counted:
        function.line(f"true_{proposition} = unknown_{proposition} = 0")
    function.line(f"for {_head(layout, columns)}:")
    for line in _one_element(layout, array):
        function.line(line, 1)
    for signal, node in folds.items():
        element = _Element(layout).value(node.element)
        folded = definition_of(node.folding.function, 2).call(PYTHON, [f"f{signal}", element])
        function.line(f"f{signal} = {folded}", 1)
    for proposition in counted:
        function.line(f"true_{proposition} += {_Element(layout).proposition(proposition)} == 1", 1)
        function.line(
            f"unknown_{proposition} += {_Element(layout).proposition(proposition)} == 2", 1
        )
    _finish(layout, array, function)
    return function.text()


def _elements(layout: PythonLayout, column: int) -> str:
    return f"elements{_ending(layout, column)}"


def _ending(layout: PythonLayout, array: int) -> str:
    """The ending of the names of a list's column; empty for an array outside of lists."""
    return "" if layout.machine.arrays[array].list is None else f"_{array}"


def _is_unknown(layout: PythonLayout, array: int) -> str:
    """A condition: the elements are unknown (S24, S51)."""
    its_list = layout.machine.arrays[array].list
    if its_list is None:
        return f"not {_elements(layout, array)}"
    columns = [_elements(layout, column) for column in layout.beside(array)]
    lacking = [f"{column} is None" for column in columns]
    others = [f"len({column}) != len({columns[0]})" for column in columns[1:]]
    too_many = f"len({columns[0]}) > {layout.machine.lists[its_list].most}"
    return " or ".join([*lacking, *others, too_many])


def _head(layout: PythonLayout, columns: Sequence[int]) -> str:
    """The head of a loop over the elements: the loop variables, and the iterated columns."""
    names = [f"e{_ending(layout, column)}" for column in columns]
    found = [_converted(layout, column) for column in columns]
    if len(columns) == 1:
        return f"{names[0]} in {found[0]}"
    return f"{', '.join(names)} in zip({', '.join(found)})"


def _finish(layout: PythonLayout, array: int, function: StartFunction) -> None:
    for signal in _folds(layout, array):
        function.assign(f"s{signal}", f"f{signal}")
    for signal, proposition in _counts(layout, array).items():
        function.assign(
            f"s{signal}", f"NAN if unknown_{proposition} else float(true_{proposition})"
        )
    for index, node in _quantifiers(layout, array).items():
        true, unknown = f"true_{node.element}", f"unknown_{node.element}"
        match node.quantifier:
            case ir.Quantifier.ANY:
                function.assign(f"q{index}", f"1 if {true} else 2 if {unknown} else 0")
            case ir.Quantifier.ALL:
                known = f"{true} + {unknown} < len({_elements(layout, array)})"
                function.assign(f"q{index}", f"0 if {known} else 2 if {unknown} else 1")


class _Element:
    """The writer of the nodes of one element."""

    def __init__(self, layout: PythonLayout) -> None:
        self._layout = layout

    def value(self, signal: int) -> str:
        node = self._layout.machine.signals[signal].node
        if isinstance(node, ir.Element):
            return f"e{_ending(self._layout, node.array)}"
        if self._layout.elements.signals[signal] is None:
            return self._layout.value(signal)
        return f"e{signal}"

    def proposition(self, index: int) -> str:
        return self._layout.proposition(index)


def _one_element(layout: PythonLayout, array: int) -> Iterator[str]:
    """The signals and propositions of the current element, each once."""
    write = _Element(layout)
    for index, signal in enumerate(layout.machine.signals):
        if layout.elements.signals[index] == array and isinstance(signal.node, ir.Apply):
            yield f"e{index} = {expressions.applied(layout, signal.node, write.value)}"
    for index, proposition in enumerate(layout.machine.propositions):
        if layout.elements.propositions[index] != array:
            continue
        if isinstance(proposition.node, ir.Not | ir.And | ir.Or):
            yield f"t{index} = {expressions.logic(proposition.node, write.proposition)}"
        else:
            yield f"t{index} = {expressions.compared(layout, proposition.node, write.value, '2')}"


def _converted(layout: PythonLayout, index: int) -> str:
    array, elements = layout.machine.arrays[index], _elements(layout, index)
    if (array.scale, array.offset) == (1.0, 0.0):
        return elements
    return f"[e * {number(array.scale)} + {number(array.offset)} for e in {elements}]"


def _folds(layout: PythonLayout, array: int) -> dict[int, ir.Fold]:
    found = {index: signal.node for index, signal in enumerate(layout.machine.signals)}
    return {
        index: node
        for index, node in found.items()
        if isinstance(node, ir.Fold) and layout.elements.signals[node.element] == array
    }


def _counts(layout: PythonLayout, array: int) -> dict[int, int]:
    found = {index: signal.node for index, signal in enumerate(layout.machine.signals)}
    return {
        index: node.element
        for index, node in found.items()
        if isinstance(node, ir.Count) and layout.elements.propositions[node.element] == array
    }


def _quantifiers(layout: PythonLayout, array: int) -> dict[int, ir.Quantified]:
    found = {
        index: proposition.node for index, proposition in enumerate(layout.machine.propositions)
    }
    return {
        index: node
        for index, node in found.items()
        if isinstance(node, ir.Quantified) and layout.elements.propositions[node.element] == array
    }


def _counted(layout: PythonLayout, array: int) -> list[int]:
    """The elementwise propositions whose true and unknown elements are counted."""
    quantified = [node.element for node in _quantifiers(layout, array).values()]
    return sorted({*_counts(layout, array).values(), *quantified})
