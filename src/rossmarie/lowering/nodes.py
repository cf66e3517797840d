"""The signals and propositions of a machine under construction. Equal nodes are shared, and
constant nodes are folded.

Every method with operands takes indices that an earlier call returned, so operands precede their
users.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable
from dataclasses import dataclass, field

from dslkit.source import Span
from rossmarie import ir
from rossmarie.ir import TruthValue, comparison
from rossmarie.units import DIMENSIONLESS, Unit


@dataclass(frozen=True)
class Shown:
    """The display of a signal or proposition, and its place in the rules file."""

    text: str
    span: Span
    unit: Unit | None = None


@dataclass
class Nodes:
    """Collects the nodes one by one. Every method returns the index of the requested node."""

    signals: list[ir.Signal] = field(default_factory=list)
    propositions: list[ir.Proposition] = field(default_factory=list)
    _settled_units: set[int] = field(default_factory=set)
    _signal_indexes: dict[object, int] = field(default_factory=dict)
    _proposition_indexes: dict[ir.PropositionNode, int] = field(default_factory=dict)

    # --- signals -----------------------------------------------------------------------------

    def constant(self, value: float, shown: Shown) -> int:
        """A known number. Equal numbers with different units are separate, because their displays
        differ.
        """
        key = (value, math.copysign(1.0, value), shown.unit)
        return self._add_signal(ir.Constant(value), key, shown)

    def signal(self, node: ir.SignalNode, shown: Shown) -> int:
        """Any signal except a constant or a function."""
        return self._add_signal(node, node, shown)

    def apply(self, function: ir.AnyFunction, operands: tuple[int, ...], shown: Shown) -> int:
        """A function of signals. The check has already computed functions of constants."""
        node = ir.Apply(function, operands)
        return self._add_signal(node, node, shown)

    def show_in(self, index: int, unit: Unit) -> None:
        """Display a signal in another unit of its dimension. The first request counts."""
        signal = self.signals[index]
        if index not in self._settled_units and not isinstance(signal.node, ir.Constant):
            self._settled_units.add(index)
            shown = Shown(signal.text, signal.span, unit)
            self.signals[index] = _signal(signal.node, shown)

    def _constant_value(self, index: int) -> float | None:
        node = self.signals[index].node
        return node.value if isinstance(node, ir.Constant) else None

    def _add_signal(self, node: ir.SignalNode, key: object, shown: Shown) -> int:
        index = self._signal_indexes.setdefault(key, len(self.signals))
        if index == len(self.signals):
            self.signals.append(_signal(node, shown))
        return index

    # --- propositions
    # ------------------------------------------------------------------------------

    def literal(self, value: bool, shown: Shown) -> int:
        """A proposition that is always true or always false."""
        return self._add_proposition(ir.Literal(value), shown)

    def leaf(self, node: ir.PropositionNode, shown: Shown) -> int:
        """A proposition about signals, inputs or elements; a literal if it compares constants."""
        value = self._folded(node)
        if value is not None:
            return self.literal(value is TruthValue.TRUE, shown)
        return self._add_proposition(node, shown)

    def negation(self, operand: int, shown: Shown) -> int:
        """The negation, `not`."""
        node = self.propositions[operand].node
        if isinstance(node, ir.Literal):
            return self.literal(not node.value, shown)
        return self._add_proposition(ir.Not(operand), shown)

    def conjunction(
        self, operands: tuple[int, ...], shown: Shown, *, of_elements: bool = False
    ) -> int:
        """The conjunction, `and`, of one or more operands, without operands that are always true. A
        proposition `of_elements` remains one, even if a literal decides it, because only the
        message shows whether there are elements.
        """
        if any(self._is_literal(operand, value=False) for operand in operands):
            if of_elements and not self._are_literals(operands):
                return self._add_proposition(ir.And(operands), shown)
            return self.literal(False, shown)
        left = _distinct(index for index in operands if not self._is_literal(index, value=True))
        if len(left) < 2:
            return left[0] if left else self.literal(True, shown)
        return self._add_proposition(ir.And(left), shown)

    def disjunction(
        self, operands: tuple[int, ...], shown: Shown, *, of_elements: bool = False
    ) -> int:
        """The disjunction, `or`, of one or more operands, without operands that are always false.
        `of_elements` is as for `conjunction`.
        """
        if any(self._is_literal(operand, value=True) for operand in operands):
            if of_elements and not self._are_literals(operands):
                return self._add_proposition(ir.Or(operands), shown)
            return self.literal(True, shown)
        left = _distinct(index for index in operands if not self._is_literal(index, value=False))
        if len(left) < 2:
            return left[0] if left else self.literal(False, shown)
        return self._add_proposition(ir.Or(left), shown)

    def held(self, operand: int, duration_ns: int, shown: Shown, *, initially: bool = False) -> int:
        """The operator `for`. Before the start, even an operand that is always true counts as
        false, unless `initially`.
        """
        if self._is_literal(operand, value=initially) or self._is_literal(operand, value=False):
            return operand
        return self._add_proposition(ir.Held(operand, duration_ns, initially), shown)

    def since(self, held: int, begun: int, shown: Shown) -> int:
        """The operator `since`. If `begun` is constant, the result is simplified; if `held` is
        never true, the result is false.
        """
        is_decided = isinstance(self.propositions[begun].node, ir.Literal)
        if is_decided or self._is_literal(held, value=False):
            return begun
        return self._add_proposition(ir.Since(held, begun), shown)

    def recurs(self, operand: int, count: int, window_ns: int, shown: Shown) -> int:
        """At least `count` edges within a time. An operand that is always false has no edges."""
        if count == 0 or self._is_literal(operand, value=False):
            return self.literal(count == 0, shown)
        return self._add_proposition(ir.Recurs(operand, count, window_ns), shown)

    def name(self, index: int, name: str) -> None:
        """Give a proposition the name of a condition. The first name stays. Literals have no name,
        because unrelated conditions share them.
        """
        proposition = self.propositions[index]
        if proposition.name is None and not isinstance(proposition.node, ir.Literal):
            self.propositions[index] = dataclasses.replace(proposition, name=name)

    def _folded(self, node: ir.PropositionNode) -> TruthValue | None:
        known = [self._constant_value(signal) for signal in ir.compared_signals(node)]
        values = tuple(value for value in known if value is not None)
        if len(values) < len(known):
            return None
        match node:
            case ir.Compare(comparison=compared):
                return comparison.compare(compared, *values)
            case ir.Between():
                return comparison.is_between(*values)
            case (
                ir.Literal() | ir.Flag() | ir.AgeReaches() | ir.Oscillates() | ir.Quantified()
                | ir.Not() | ir.And() | ir.Or() | ir.Held() | ir.Since() | ir.Recurs()
            ):  # fmt: skip
                return None

    def _is_literal(self, index: int, *, value: bool) -> bool:
        return self.propositions[index].node == ir.Literal(value)

    def _are_literals(self, operands: tuple[int, ...]) -> bool:
        return all(isinstance(self.propositions[each].node, ir.Literal) for each in operands)

    def _add_proposition(self, node: ir.PropositionNode, shown: Shown) -> int:
        index = self._proposition_indexes.setdefault(node, len(self.propositions))
        if index == len(self.propositions):
            self.propositions.append(ir.Proposition(node, None, shown.text, shown.span))
        return index


def _distinct(indexes: Iterable[int]) -> tuple[int, ...]:
    return tuple(dict.fromkeys(indexes))


def _signal(node: ir.SignalNode, shown: Shown) -> ir.Signal:
    unit = DIMENSIONLESS if shown.unit is None else shown.unit
    symbol = "" if unit == DIMENSIONLESS else unit.symbol
    scale = 1.0 / unit.scale
    offset = -unit.offset / unit.scale if unit.offset else 0.0
    return ir.Signal(node, shown.text, symbol, scale, offset, shown.span)
