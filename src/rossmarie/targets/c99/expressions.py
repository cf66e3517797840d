"""Signals and tests as C expressions and statements.

The input is a layout. The results are *pieces*: statements with the channels whose messages require
them, in an order in which operands come first.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from rossmarie import ir
from rossmarie.core import AnyFunction, SampleNumber, may_be_infinite, sampling_row
from rossmarie.targets.c99.functions import C
from rossmarie.targets.c99.layout import CLayout, SampleWindow
from rossmarie.targets.c99.types import number
from rossmarie.targets.formulas import FunctionDefinition, definition_of, definition_of_samples


@dataclass(frozen=True)
class ChannelStatements:
    """Statements that a message on any of the channels requires."""

    channels: frozenset[int]
    lines: tuple[str, ...]


class Expressions:
    """Writes the signals of one machine. `functions` collects the names of the core functions that
    the signals call.
    """

    def __init__(self, layout: CLayout) -> None:
        self._layout = layout
        self._machine = layout.machine
        self.functions: set[str] = set()
        self._prepared = ir.made_beside(self._machine)
        self._infinite: list[bool] = []
        for signal in self._machine.signals:
            self._infinite.append(self._may_be_infinite(signal.node))

    def operand(self, signal: int) -> str:
        """The expression for a stored signal, or for a constant."""
        node = self._machine.signals[signal].node
        if isinstance(node, ir.Constant):
            return number(node.value)
        return self.kept(self._layout.value_of_signal[signal])

    def kept(self, value: int) -> str:
        """A value in the memory of the monitor."""
        return f"m->value[{self._layout.values[value].name}]"

    def arrival(self, slot: int, raw: str, *, is_raw: bool) -> str:
        """A scalar of a message, converted to SI, and unknown if it is not finite, unless
        `is_raw`.
        """
        declared = self._machine.slots[slot]
        text = converted(raw, declared.scale, declared.offset)
        if not is_raw:
            text = f"known({text})"
        return f"{self.kept(self._layout.value_of_slot[slot])} = {text};"

    def signals(self) -> Iterator[ChannelStatements]:
        """The computed signals, without those over arrays and beside elements, and the statements
        that store their samples.
        """
        remembered: set[str] = set()
        for index, signal in enumerate(self._machine.signals):
            if isinstance(signal.node, ir.Fold | ir.Count) or index not in self._computed():
                continue
            channels = self._layout.supports.signals[index].channels
            if channels and index in self._prepared:
                continue
            if isinstance(signal.node, ir.Sampled):
                if not channels:
                    continue  # a constant is never sampled: its rate stays unknown
                taken = self._taken(index, signal.node)
                if taken not in remembered:
                    remembered.add(taken)
                    yield ChannelStatements(channels, (taken,))
            target = self.kept(self._layout.value_of_signal[index])
            yield ChannelStatements(channels, (f"{target} = {self._signal(index, signal.node)};",))
            if isinstance(signal.node, ir.Sampled) and _feeds_back(signal.node):
                replaced = f"sample(m, {self._layout.sampled.index(index)}, {target}, t_ns);"
                remembered.add(replaced)
                yield ChannelStatements(channels, (replaced,))

    def prepared(self) -> Iterator[ChannelStatements]:
        """The signals beside elements, which are computed before any result over the elements."""
        for index, signal in enumerate(self._machine.signals):
            channels = self._layout.supports.signals[index].channels
            if channels and index in self._prepared and isinstance(signal.node, ir.Apply):
                target = self.kept(self._layout.value_of_signal[index])
                yield ChannelStatements(
                    channels, (f"{target} = {self._signal(index, signal.node)};",)
                )

    def tests(self) -> Iterator[ChannelStatements]:
        """Comparisons without fixed limits, as numbers."""
        for proposition, value in self._layout.value_of_test.items():
            node = self._machine.propositions[proposition].node
            if not isinstance(node, ir.Quantified):
                outcome = f"outcome({', '.join(self.comparison(node, self.operand))})"
                channels = self._layout.supports.propositions[proposition].channels
                yield ChannelStatements(channels, (f"{self.kept(value)} = {outcome};",))

    # --- signals -----------------------------------------------------------------------------

    def _computed(self) -> dict[int, int]:
        slots = {
            index
            for index, signal in enumerate(self._machine.signals)
            if isinstance(signal.node, ir.Read)
        }
        kept = self._layout.value_of_signal
        return {signal: value for signal, value in kept.items() if signal not in slots}

    def _taken(self, index: int, node: ir.Sampled) -> str:
        """The statement that takes a sample. For a function that feeds back, the result replaces
        the sample.
        """
        x = self.operand(node.signal)
        if sampling_row(node.function).has_window:
            return f"sample_window(m, {self._window(node)}, {x}, t_ns);"
        return f"sample(m, {self._last_two(index, node)}, {x}, t_ns);"

    def _last_two(self, index: int, node: ir.Sampled) -> int:
        return self._layout.sampled.index(index if _feeds_back(node) else node.signal)

    def _window(self, node: ir.Sampled) -> int:
        return self._layout.windows.index(SampleWindow(node.signal, node.window_ns))

    def _signal(self, index: int, node: ir.SignalNode) -> str:
        match node:
            case ir.Apply():
                return self.applied(node, self.operand)
            case ir.Sampled(function=function):
                declared = sampling_row(function)
                views = [self._view(index, node, view) for view in declared.views]
                text = self._call(definition_of_samples(function), views)
                if declared.keeps_infinities:
                    return text
                return f"known({text})"
            case ir.Constant() | ir.Read() | ir.Element() | ir.Fold() | ir.Count():
                raise AssertionError(f"{type(node).__name__} is not computed from numbers")

    def _view(self, index: int, node: ir.Sampled, view: SampleNumber) -> str:
        match view:
            case SampleNumber.NEWEST:
                return f"m->latest[{self._last_two(index, node)}]"
            case SampleNumber.BEFORE:
                return f"m->before[{self._last_two(index, node)}]"
            case SampleNumber.SECONDS:
                return f"seconds_between(m, {self._last_two(index, node)})"
            case SampleNumber.LOWER:
                return f"window_middle(m, {self._window(node)}, 0)"
            case SampleNumber.UPPER:
                return f"window_middle(m, {self._window(node)}, 1)"
            case SampleNumber.TOTAL:
                return f"window_total(m, {self._window(node)})"
            case SampleNumber.COUNT:
                return f"(double)m->window_count[{self._window(node)}]"
            case SampleNumber.CONSTANT:
                return number(float(node.window_ns) / 1e9)

    def applied(self, node: ir.Apply, write: Callable[[int], str]) -> str:
        """A function of operands that `write` writes; unknown if it is not finite (S4)."""
        text = self.called(node.function, [write(operand) for operand in node.operands])
        is_infinite = any(self._infinite[operand] for operand in node.operands)
        if not may_be_infinite(node.function, len(node.operands), of_infinite=is_infinite):
            return text
        return f"known({text})"

    def called(self, function: AnyFunction, operands: list[str]) -> str:
        """A function with these operands, before S4 applies."""
        return self._call(definition_of(function, len(operands)), operands)

    def _call(self, definition: FunctionDefinition, operands: list[str]) -> str:
        self.functions.add(definition.name)
        return definition.call(C, operands)

    def _may_be_infinite(self, node: ir.SignalNode) -> bool:
        match node:
            case ir.Element() | ir.Fold():
                return True
            case ir.Sampled(function=function, signal=signal):
                return sampling_row(function).keeps_infinities and self._infinite[signal]
            case ir.Constant() | ir.Read() | ir.Apply() | ir.Count():
                return False

    # --- comparisons -------------------------------------------------------------------------

    def comparison(self, node: ir.PropositionNode, write: Callable[[int], str]) -> tuple[str, str]:
        """The conditions that an operand is NaN, and that the comparison holds if no operand is
        NaN.
        """
        match node:
            case ir.Compare(comparison=comparison, left=left, right=right):
                holds = f"{write(left)} {comparison.value} {write(right)}"
                return self._unknown((left, right), write), holds
            case ir.Between(signal=signal, low=low, high=high):
                x = write(signal)
                holds = f"{write(low)} <= {x} && {x} <= {write(high)}"
                return self._unknown((signal, low, high), write), holds
            case ir.Flag(signal=signal):
                return self._unknown((signal,), write), f"{write(signal)} != 0.0"
            case (
                ir.Literal() | ir.AgeReaches() | ir.Oscillates() | ir.Quantified() | ir.Not()
                | ir.And() | ir.Or() | ir.Held() | ir.Since() | ir.Recurs()
            ):  # fmt: skip
                raise AssertionError(f"{type(node).__name__} does not compare")

    def _unknown(self, signals: tuple[int, ...], write: Callable[[int], str]) -> str:
        nodes = self._machine.signals
        variable = [s for s in signals if not isinstance(nodes[s].node, ir.Constant)]
        return " || ".join(f"isnan({write(signal)})" for signal in variable) or "false"


def _feeds_back(node: ir.Sampled) -> bool:
    return sampling_row(node.function).feeds_back


def converted(raw: str, scale: float, offset: float) -> str:
    """A received number, converted to SI."""
    if scale == 1.0 and offset == 0.0:
        return raw
    return f"{raw} * {number(scale)} + {number(offset)}"
