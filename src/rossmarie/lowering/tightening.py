"""Parameters of the node that do not tighten the rules that use them. With a tighter value, a rule
must be active whenever it was active before, and must not be cleared earlier (S87).

Moves are the directions in which a number, or a proposition from false to true, can change when
parameters are tightened. A number of unknown direction may move both ways.
"""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import Diagnostic
from rossmarie import ir
from rossmarie.check.instances.errors import CannotTighten
from rossmarie.core import row
from rossmarie.ir import Comparison, Function

_Moves = frozenset[int]

_NONE: _Moves = frozenset()
_UP: _Moves = frozenset({1})
_DOWN: _Moves = frozenset({-1})
_BOTH = _UP | _DOWN
_LIKE_BOTH = frozenset({Function.ADD, Function.MINIMUM, Function.MAXIMUM})
_LESS = frozenset({Comparison.LESS, Comparison.LESS_OR_EQUAL})
_GREATER = frozenset({Comparison.GREATER, Comparison.GREATER_OR_EQUAL})


def misdirected(machine: ir.Machine) -> Iterator[Diagnostic]:
    """A finding for each rule that a parameter of the node could loosen, and for all other nodes
    that depend on a parameter.
    """
    if not ir.settings_of(machine):
        return
    moves = _MovesOf(machine)
    for rule in machine.rules:
        if -1 in moves.proposition(rule.condition):
            yield moves.finding(rule.condition, -1, rule)
        elif rule.release is not None and 1 in moves.proposition(rule.release):
            yield moves.finding(rule.release, 1, rule)
    for proposition in machine.watches:
        if moves.proposition(proposition):
            yield moves.finding(proposition, min(moves.proposition(proposition)), None)


def _turned(moves: _Moves) -> _Moves:
    return frozenset(-each for each in moves)


def _times(moves: _Moves, sign: int | None) -> _Moves:
    """The moves of a product with a number of this sign; None if the sign is unknown."""
    if sign is None:
        return _BOTH if moves else _NONE
    return moves if sign > 0 else _turned(moves)


class _MovesOf:
    """The moves of the signals and propositions of a machine."""

    def __init__(self, machine: ir.Machine) -> None:
        self._machine = machine
        self._signals: list[_Moves] = []
        self._signs: list[int | None] = []
        self._propositions: dict[int, _Moves] = {}
        for signal in machine.signals:
            self._signals.append(self._of_signal(signal.node))
            self._signs.append(self._sign(signal.node))
        for index in range(len(machine.propositions)):
            self.proposition(index)

    def proposition(self, index: int) -> _Moves:
        """The moves of a proposition. Propositions follow their operands, so the recursion stays
        shallow.
        """
        if index not in self._propositions:
            self._propositions[index] = self._of_proposition(self._machine.propositions[index].node)
        return self._propositions[index]

    # --- signals -----------------------------------------------------------------------------

    def _of_signal(self, node: ir.SignalNode) -> _Moves:
        match node:
            case ir.Constant() | ir.Read() | ir.Element():
                return _NONE
            case ir.Fold(element=element):
                return self._signals[element]
            case ir.Count(element=element):
                return self.proposition(element)
            case ir.Sampled(signal=signal):
                return _BOTH if self._signals[signal] else _NONE
            case ir.Apply():
                if ir.setting_numbers(self._machine, node) is not None:
                    return _UP if node.function is Function.RAISED else _DOWN
                return self._of_function(node)

    def _of_function(self, node: ir.Apply) -> _Moves:
        moves = [self._signals[each] for each in node.operands]
        signs = [self._signs[each] for each in node.operands]
        if not any(moves):
            return _NONE
        if node.function in _LIKE_BOTH:
            return moves[0] | moves[1]
        match node.function, moves, signs:
            case Function.SUBTRACT, [left, right], _:
                return left | _turned(right)
            case Function.NEGATE, [operand], _:
                return _turned(operand)
            case Function.ABSOLUTE, [operand], [sign]:
                return _times(operand, sign)
            case Function.MULTIPLY, [left, right], [first, second]:
                return _times(left, second) | _times(right, first)
            case Function.DIVIDE, [left, right], [first, second]:
                divided = (
                    _times(_turned(right), first) if second is not None else _times(right, None)
                )
                return _times(left, second) | divided
            case _:  # open: a function whose direction is unknown
                return _BOTH

    def _sign(self, node: ir.SignalNode) -> int | None:
        """1 for a signal that is never below zero, -1 for a signal that is never above zero, else
        None. A divisor is never zero, because a quotient by zero is unknown.
        """
        if isinstance(node, ir.Constant):
            return 1 if node.value >= 0.0 else -1
        if not isinstance(node, ir.Apply):
            return None
        is_square = node.function is Function.MULTIPLY and len(set(node.operands)) == 1
        if is_square or row(node.function).range[0] >= 0.0:
            return 1
        signs = [self._signs[each] for each in node.operands]
        match node.function, signs:
            case ((Function.RAISED | Function.LOWERED), [_, usual, far]) if usual == far:
                return usual
            case ((Function.ADD | Function.MINIMUM | Function.MAXIMUM), [left, right]):
                return left if left == right else None
            case ((Function.MULTIPLY | Function.DIVIDE), [int(left), int(right)]):
                return left * right
            case Function.NEGATE, [int(operand)]:
                return -operand
            case _:  # open: a function whose sign is unknown
                return None

    # --- propositions
    # ------------------------------------------------------------------------------

    def _of_proposition(self, node: ir.PropositionNode) -> _Moves:
        match node:
            case ir.Literal() | ir.AgeReaches():
                return _NONE
            case ir.Compare(comparison=comparison, left=left, right=right):
                return self._compared(comparison, self._signals[left], self._signals[right])
            case ir.Between(signal=signal, low=low, high=high):
                value = _BOTH if self._signals[signal] else _NONE
                return value | _turned(self._signals[low]) | self._signals[high]
            case ir.Flag(signal=signal) | ir.Oscillates(signal=signal):
                return _BOTH if self._signals[signal] else _NONE
            case ir.Not(operand=operand):
                return _turned(self.proposition(operand))
            case ir.And(operands=operands) | ir.Or(operands=operands):
                return _NONE.union(*map(self.proposition, operands))
            case ir.Quantified(element=operand) | ir.Held(operand=operand):
                return self.proposition(operand)
            case ir.Since(held=held, begun=begun):
                return self.proposition(held) | self.proposition(begun)
            case ir.Recurs(operand=operand):
                return _BOTH if self.proposition(operand) else _NONE

    def _compared(self, comparison: Comparison, left: _Moves, right: _Moves) -> _Moves:
        if comparison in _LESS:
            return _turned(left) | right
        if comparison in _GREATER:
            return left | _turned(right)
        return _BOTH if left or right else _NONE

    # --- findings ----------------------------------------------------------------------------

    def finding(self, proposition: int, move: int, rule: ir.Rule | None) -> Diagnostic:
        """The finding at the part of a proposition that moves in the wrong direction."""
        node = self._machine.propositions[proposition].node
        while (inner := self._inside(node, move)) is not None:
            proposition, move = inner
            node = self._machine.propositions[proposition].node
        place = self._machine.propositions[proposition]
        is_certain = len(self.proposition(proposition)) == 1
        reason = "a tighter value would make this {}".format("true" if move > 0 else "false")
        if rule is None:
            reason = "a confirmation cannot be tightened"
        elif not is_certain:
            reason = "a tighter value could make this true or false"
        return CannotTighten(reason=reason).at(place.span)

    def _inside(self, node: ir.PropositionNode, move: int) -> tuple[int, int] | None:
        """The operand of a proposition that moves in the wrong direction, and that direction."""
        match node:
            case ir.Not(operand=operand):
                return operand, -move
            case ir.And(operands=operands) | ir.Or(operands=operands):
                return next((each, move) for each in operands if move in self.proposition(each))
            case ir.Held(operand=operand):
                return operand, move
            case ir.Since(held=held, begun=begun):
                return (held, move) if move in self.proposition(held) else (begun, move)
            case (
                ir.Literal() | ir.AgeReaches() | ir.Compare() | ir.Between() | ir.Flag()
                | ir.Oscillates() | ir.Quantified() | ir.Recurs()
            ):  # fmt: skip
                return None
