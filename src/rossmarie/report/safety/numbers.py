"""The signals of a machine in words: `the pitch of orientation`, `10 deg (steepest)`.

The input is a machine that `ir.verify` has accepted. A signal with more than `MOST_PARTS` operands
has a number as its name, and a full description in a place of its own. Otherwise, shared operands
would be repeated many times.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from rossmarie import ir
from rossmarie.core import row, sampling_row
from rossmarie.ir.calls import query_at
from rossmarie.ir.duration_text import duration_text
from rossmarie.ir.naming import field_names
from rossmarie.ir.path import path_words
from rossmarie.ir.support import signal_operands

MOST_PARTS = 24

_AXES = ("x", "y", "z", "w")


def sizes(operands: Iterable[Iterable[int]]) -> list[int]:
    """The sizes of nodes, given the operands of each, which precede it. A node with its own
    description counts as one.
    """
    found: list[int] = []
    for parts in operands:
        known = (found[part] for part in parts)
        found.append(1 + sum(1 if size > MOST_PARTS else size for size in known))
    return found


def number(value: float) -> str:
    """A number in readable form. A 0 has no sign."""
    return f"{value + 0.0:.12g}"


def quantity(value: float, unit: str) -> str:
    """A number with its unit."""
    return f"{number(value)} {unit}".rstrip()


class NumberWords:
    """The words for each signal of one machine. `each` gives the words for a condition on the
    current element.
    """

    def __init__(self, machine: ir.Machine, each: Callable[[int], str]) -> None:
        self._machine = machine
        self._each = each
        slots, arrays = field_names(machine)
        written = {signal.node: signal.text for signal in machine.signals}
        self._slots = [
            _field_name(machine, slot, slots[index], written.get(ir.Read(index)))
            for index, slot in enumerate(machine.slots)
        ]
        self._arrays = [
            _field_name(machine, array, arrays[index], written.get(ir.Element(index)))
            for index, array in enumerate(machine.arrays)
        ]
        lists = zip(machine.lists, ir.list_names(machine), strict=True)
        self._lists = [_field_name(machine, each, names, None) for each, names in lists]
        self._sizes = sizes(signal_operands(signal.node) for signal in machine.signals)
        self.apart: dict[int, None] = {}
        """The signals that have a number as their name, and are described in full elsewhere."""

    def words(self, index: int) -> str:
        """A signal by its name, its meaning or its number."""
        if self._sizes[index] > MOST_PARTS:
            self.apart.setdefault(index)
            return f"number {index}"
        return self.in_full(index)

    def in_full(self, index: int) -> str:
        """A signal in terms of its operands."""
        signal = self._machine.signals[index]
        match signal.node:
            case ir.Constant():
                return self._constant(signal)
            case ir.Read(slot=slot):
                return self._slots[slot]
            case ir.Apply(function=function, operands=operands):
                return self._applied(function, operands)
            case ir.Sampled(function=sampling, signal=inner, window_ns=window_ns):
                return sampling_row(sampling).worded(self.words(inner), duration_text(window_ns))
            case ir.Element(array=array):
                return self._element(self._machine.arrays[array])
            case ir.Fold(folding=folding, element=element):
                return self._fold(folding, element)
            case ir.Count(element=element):
                whole = f"the number of elements of {self.array_of(element)}"
                is_of_all = _is_always(self._machine.propositions[element].node)
                return whole if is_of_all else f"{whole} with ({self._each(element)})"

    def slot(self, index: int) -> str:
        """A field of a message."""
        return self._slots[index]

    def array(self, index: int) -> str:
        """An array of a message."""
        return self._arrays[index]

    def array_of(self, proposition: int) -> str:
        """The array or list whose elements a condition uses."""
        array = ir.element_arrays(self._machine).propositions[proposition]
        return "no array" if array is None else self._whole(array)

    def _whole(self, array: int) -> str:
        """An array, or the list that has the array as a column."""
        its_list = self._machine.arrays[array].list
        return self._arrays[array] if its_list is None else self._lists[its_list]

    def _element(self, array: ir.Array) -> str:
        """The current element of an array, or a field of the current element of a list."""
        if array.list is None:
            return "the element"
        return f"its {path_words(array.path[array.path.index(ir.EACH) + 1 :])}"

    def range(self, low: int, high: int) -> str:
        """The two ends of a range. A constant that names both is named once."""
        ends = (self._machine.signals[low], self._machine.signals[high])
        name = ends[0].text
        if name.isidentifier() and all(
            isinstance(end.node, ir.Constant) and end.text == name for end in ends
        ):
            values = (self._value(end) for end in ends)
            return f"{' to '.join(values)} ({name})"
        return f"{self.words(low)} to {self.words(high)}"

    def _constant(self, signal: ir.Signal) -> str:
        name = f" ({signal.text})" if signal.text.isidentifier() else ""
        return self._value(signal) + name

    def _value(self, signal: ir.Signal) -> str:
        assert isinstance(signal.node, ir.Constant), "asked before"
        return quantity(signal.node.value * signal.scale + signal.offset, signal.unit)

    def _applied(self, function: ir.AnyFunction, operands: tuple[int, ...]) -> str:
        words = [self.words(operand) for operand in operands]
        return row(function).worded(words, _vector(words))

    def _fold(self, folding: ir.Folding, element: int) -> str:
        which = _extreme(folding)
        array = ir.element_arrays(self._machine).signals[element]
        assert array is not None, "verified: a fold is over elements"
        is_plain = isinstance(self._machine.signals[element].node, ir.Element)
        if is_plain and self._machine.arrays[array].list is None:
            return f"the {which} element of {self._arrays[array]}"
        each = self.words(element)
        return f"the {which}, over all elements of {self._whole(array)}, of {each}"


def _is_always(node: ir.PropositionNode) -> bool:
    """Say whether a condition is true for each element, for example that a number equals itself."""
    is_equal = isinstance(node, ir.Compare) and node.comparison is ir.Comparison.EQUAL
    return is_equal and isinstance(node, ir.Compare) and node.left == node.right


def _extreme(folding: ir.Folding) -> str:
    match folding:
        case ir.Folding.MINIMUM:
            return "least"
        case ir.Folding.MAXIMUM:
            return "greatest"


def _vector(words: Sequence[str]) -> str:
    """`orientation` if these are its x, y, z and w, else all names in brackets."""
    whole, _, _ = words[0].rpartition(".")
    if whole and list(words) == [f"{whole}.{axis}" for axis in _AXES[: len(words)]]:
        return whole
    return f"({', '.join(words)})"


def _field_name(
    machine: ir.Machine,
    field: ir.Slot | ir.Array | ir.List,
    names: frozenset[str],
    written: str | None,
) -> str:
    """The name in the rules, if it means only this field; else the shortest unique name, or the
    whole path. A query about running skills has its own words.
    """
    query = query_at(field.path)
    if query is not None:
        return str(query)
    if written in names:
        return written
    path = ".".join((machine.inputs[field.input].name, *ir.path_names(field.path)))
    return min(names, key=lambda name: (len(name), name), default=path)
