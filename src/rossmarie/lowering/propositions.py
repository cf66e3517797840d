"""Expressions that are true, false or unknown.

The name of a condition stands for the condition's proposition. Conditions are lowered once, before
the expressions that refer to them.
"""

from __future__ import annotations

import sys

from rossmarie import ir
from rossmarie.check.model import CheckedKeeps, CheckedProgram, ConditionKey, Value
from rossmarie.check.operations.operands import is_age, is_edge_count
from rossmarie.check.scopes.trees import stripped
from rossmarie.core import RegionFunction, RegionMeasure
from rossmarie.lowering.durations import duration_ns
from rossmarie.lowering.inputs import InputLowering
from rossmarie.lowering.nodes import Nodes, Shown
from rossmarie.lowering.numbers import NumberLowering
from rossmarie.lowering.references import conditions_in, referred_condition
from rossmarie.lowering.skills import SkillLowering
from rossmarie.lowering.wording import words
from rossmarie.syntax import ast
from rossmarie.types import Box, Text
from rossmarie.units import DIMENSIONLESS, Unit, parse_unit

_METRE = parse_unit("m")

_COMPARISONS = {
    ast.BinaryOperator.EQUAL: ir.Comparison.EQUAL,
    ast.BinaryOperator.NOT_EQUAL: ir.Comparison.NOT_EQUAL,
    ast.BinaryOperator.LESS: ir.Comparison.LESS,
    ast.BinaryOperator.LESS_OR_EQUAL: ir.Comparison.LESS_OR_EQUAL,
    ast.BinaryOperator.GREATER: ir.Comparison.GREATER,
    ast.BinaryOperator.GREATER_OR_EQUAL: ir.Comparison.GREATER_OR_EQUAL,
}


class Propositions:
    """Lowers conditions of one program. `skills` lowers their queries about skills."""

    def __init__(self, program: CheckedProgram, inputs: InputLowering, nodes: Nodes) -> None:
        self._program = program
        self._inputs = inputs
        self._nodes = nodes
        self.skills = SkillLowering(program, inputs, nodes)
        self._numbers = NumberLowering(program, inputs, nodes, self._element)
        self._conditions: dict[ConditionKey, int] = {}
        self._is_inside = False

    def lower(self, node: ast.Expression) -> int:
        """The proposition of a condition of a rule or a contract."""
        self._lower_conditions(node)
        return self._proposition(node, None)

    def too_late(self, keeps: CheckedKeeps, shown: Shown) -> int:
        """The proposition that a motion is closer to some locations than its stopping distance."""
        function = RegionFunction(RegionMeasure.DISTANCE, keeps.region)
        wanted = Shown(keeps.frame, keeps.written.place.span)
        metres = Shown(f"distance from {keeps.region.about}", shown.span, _METRE)
        numbers, position = self._numbers, keeps.motion.position
        distance = numbers.of_region(function, position, wanted, metres)
        slowing = Shown(
            f"distance in which {keeps.written.motion.text} slows down", shown.span, _METRE
        )
        needed = numbers.stopping_distance(keeps.motion, keeps.speed, slowing)
        return self._nodes.leaf(ir.Compare(ir.Comparison.LESS, distance, needed), shown)

    def pose(self, node: ast.Expression) -> tuple[tuple[int, ...], int]:
        """The signals of a pose, and the proposition that the pose is known. Because of this
        proposition, monitors keep the numbers.
        """
        signals = self._numbers.pose(node)
        shown = _shown(node)
        greatest = self._nodes.constant(sys.float_info.max, Shown("the greatest number", node.span))
        known = [
            self._nodes.leaf(
                ir.Compare(ir.Comparison.LESS_OR_EQUAL, signal, greatest),
                Shown(f"{shown.text} is known", node.span),
            )
            for signal in signals
        ]
        return signals, self._nodes.conjunction(
            tuple(known), Shown(f"all of {shown.text} is known", node.span)
        )

    def _lower_conditions(self, node: ast.Expression) -> None:
        """Lower all conditions that a node names, the deepest condition first. Chains of names
        cause no recursion.
        """
        waiting = list(conditions_in(node, None, self._program.symbols))[::-1]
        while waiting:
            key = waiting[-1]
            expression = self._program.symbols.conditions[key].expression
            missing = [
                other
                for other in conditions_in(expression, key[0], self._program.symbols)
                if other not in self._conditions
            ]
            if key in self._conditions or not missing:
                waiting.pop()
                self._lower_condition(key, expression)
            else:
                waiting += reversed(missing)

    def _lower_condition(self, key: ConditionKey, expression: ast.Expression) -> None:
        if key not in self._conditions:
            self._conditions[key] = self._proposition(expression, key[0])
            self._nodes.name(self._conditions[key], ".".join(key))

    # --- expressions -------------------------------------------------------------------------

    def _proposition(self, node: ast.Expression, entity: str | None) -> int:
        """The proposition of a node inside an entity, or inside a rule."""
        constant = self._program.values.get(node)
        if constant is not None:
            return self._nodes.literal(bool(constant.boolean), _shown(node))
        key = referred_condition(node, entity, self._program.symbols)
        if key is not None:
            return self._conditions[key]
        match node:
            case ast.Parenthesized(inner=content):
                return self._proposition(content, entity)
            case ast.Unary(operand=operand):
                return self._nodes.negation(self._proposition(operand, entity), _shown(node))
            case ast.Binary(operator=ast.BinaryOperator.AND | ast.BinaryOperator.OR):
                return self._junction(node, entity)
            case ast.Binary():
                return self._comparison(node, entity)
            case ast.Membership():
                return self._membership(node)
            case (ast.Held() | ast.Since() | ast.Once() | ast.Response()) as over_time:
                return self._over_time(over_time, entity)
            case ast.Oscillates() | ast.Doing() | ast.Call() | ast.ListFold():
                return self._query(node)
            case (
                ast.Number() | ast.Boolean() | ast.Text() | ast.Bracket() | ast.Reference()
                | ast.Member() | ast.Index() | ast.Sector() | ast.Edges() | ast.Broken()
            ):  # fmt: skip
                flag = self._numbers.scalar(node)
                return self._nodes.leaf(ir.Flag(flag), _shown(node))

    def _junction(self, node: ast.Binary, entity: str | None) -> int:
        operands = tuple(self._proposition(part, entity) for part in _parts(node, node.operator))
        is_and = node.operator is ast.BinaryOperator.AND
        join = self._nodes.conjunction if is_and else self._nodes.disjunction
        return join(operands, _shown(node), of_elements=self._is_inside)

    # --- over time ---------------------------------------------------------------------------

    def _over_time(
        self, node: ast.Held | ast.Since | ast.Once | ast.Response, entity: str | None
    ) -> int:
        match node:
            case ast.Held(condition=condition, duration=duration):
                operand = self._proposition(condition, entity)
                return self._nodes.held(operand, self._duration_ns(duration), _shown(node))
            case ast.Since(held=held, begun=begun):
                sides = self._proposition(held, entity), self._proposition(begun, entity)
                return self._nodes.since(*sides, _shown(node))
            case ast.Once():
                return self._once(node, entity)
            case ast.Response():
                return self._response(node, entity)

    def _once(self, node: ast.Once, entity: str | None) -> int:
        """S45: `not (not A for T)`, where `not A` counts as true before the start."""
        calm = f"not {_operand(node.condition)}"
        operand = self._proposition(node.condition, entity)
        never = self._nodes.negation(operand, Shown(calm, node.span))
        text = f"{calm} for {words(node.duration.span)}"
        duration_ns = self._duration_ns(node.duration)
        held = self._nodes.held(never, duration_ns, Shown(text, node.span), initially=True)
        return self._nodes.negation(held, _shown(node))

    def _response(self, node: ast.Response, entity: str | None) -> int:
        """S46: `not ((not B since (A and not B)) for T)`."""
        cause, answer = (
            self._proposition(node.cause, entity),
            self._proposition(node.answer, entity),
        )
        missing = f"not {_operand(node.answer)}"
        begun = f"{_operand(node.cause)} and {missing}"
        pending = f"({missing} since ({begun}))"
        without = self._nodes.negation(answer, Shown(missing, node.span))
        both = self._nodes.conjunction((cause, without), Shown(begun, node.span))
        since = self._nodes.since(without, both, Shown(pending[1:-1], node.span))
        text = f"{pending} for {words(node.duration.span)}"
        overdue = self._nodes.held(since, self._duration_ns(node.duration), Shown(text, node.span))
        return self._nodes.negation(overdue, _shown(node))

    # --- leaves ------------------------------------------------------------------------------

    def _comparison(self, node: ast.Binary, entity: str | None) -> int:
        compared = _COMPARISONS[node.operator]
        if is_edge_count(node.left):
            return self._edges(node.left, compared, node.right, node, entity)
        if is_edge_count(node.right):
            return self._edges(node.right, compared.mirrored, node.left, node, entity)
        if is_age(node.left):
            return self._age(node.left, compared, node.right, node)
        if is_age(node.right):
            return self._age(node.right, compared.mirrored, node.left, node)
        left, right = self._numbers.scalar(node.left), self._numbers.scalar(node.right)
        if node.left in self._program.values and isinstance(self._numbers.type_of(node.left), Text):
            left, right = right, left
        self._show_alike(left, node.right)
        self._show_alike(right, node.left)
        return self._nodes.leaf(ir.Compare(compared, left, right), _shown(node))

    def _show_alike(self, signal: int, other: ast.Expression) -> None:
        """Display a signal in the unit of the constant that it is compared with: `deg`, not
        `rad`.
        """
        unit = self._numbers.shown(other).unit
        if other in self._program.values and unit is not None:
            self._nodes.show_in(signal, unit)

    def _age(
        self, age: ast.Expression, compared: ir.Comparison, limit: ast.Expression, node: ast.Binary
    ) -> int:
        """The proposition about an age. Ages are whole nanoseconds: more than d is at least d + 1
        ns.
        """
        place = self._numbers.place(_arguments(age)[0])
        assert place is not None, "checked: only inputs have an age"
        is_strict = compared in (ir.Comparison.GREATER, ir.Comparison.LESS_OR_EQUAL)
        age_ns = self._duration_ns(limit) + (1 if is_strict else 0)
        reached = ir.AgeReaches(self._inputs.input(place.input), age_ns)
        sign = ">" if is_strict else ">="
        text = f"{words(age.span)} {sign} {words(limit.span)}"
        index = self._nodes.leaf(reached, Shown(text, node.span))
        if compared in (ir.Comparison.GREATER, ir.Comparison.GREATER_OR_EQUAL):
            return index
        return self._nodes.negation(index, _shown(node))

    def _edges(
        self,
        counted: ast.Expression,
        compared: ir.Comparison,
        limit: ast.Expression,
        node: ast.Binary,
        entity: str | None,
    ) -> int:
        """S48: the proposition about a count of edges. More than n edges are at least n + 1."""
        (edges,) = _arguments(counted)
        assert isinstance(edges, ast.Edges), "asked before"
        assert edges.window is not None, "checked"
        operand = self._proposition(edges.condition, entity)
        window_ns = self._duration_ns(edges.window)
        number = int(self._program.values[limit].numbers[0])

        def at_least(count: int) -> int:
            sign = ">=" if count == number else ">"
            text = f"{words(counted.span)} {sign} {words(limit.span)}"
            return self._nodes.recurs(operand, count, window_ns, Shown(text, node.span))

        def more() -> int:
            return at_least(number + 1)

        def fewer() -> int:
            return self._nodes.negation(at_least(number), _shown(node))

        match compared:
            case ir.Comparison.GREATER:
                return more()
            case ir.Comparison.GREATER_OR_EQUAL:
                return at_least(number)
            case ir.Comparison.LESS:
                return fewer()
            case ir.Comparison.LESS_OR_EQUAL:
                return self._nodes.negation(more(), _shown(node))
            case ir.Comparison.NOT_EQUAL:
                return self._nodes.disjunction((fewer(), more()), _shown(node))
            case ir.Comparison.EQUAL:
                no_more = self._nodes.negation(more(), _shown(node))
                return self._nodes.conjunction((at_least(number), no_more), _shown(node))

    def _changed(self, node: ast.Call) -> int:
        """S47: a component differs from its previous sample."""
        (argument,) = node.arguments
        now = self._numbers.components(argument)
        before = self._numbers.previous(argument)
        texts = [words(node.span)]
        if len(now) > 1:
            texts = [f"changed({words(argument.span)}.{axis})" for axis in "xyz"]
        parts = tuple(
            self._nodes.leaf(ir.Compare(ir.Comparison.NOT_EQUAL, *pair), Shown(text, node.span))
            for text, *pair in zip(texts, now, before, strict=True)
        )
        return self._nodes.disjunction(parts, _shown(node))

    def _membership(self, node: ast.Membership) -> int:
        inside = Shown(f"{words(node.value.span)} in {words(node.container.span)}", node.span)
        if stripped(node.container) in self._program.regions:
            sides = (node.value, node.container)
            signal = self._numbers.of_named_region(RegionMeasure.INSIDE, *sides, inside)
            index = self._nodes.leaf(ir.Flag(signal), inside)
            return self._nodes.negation(index, _shown(node)) if node.is_negated else index
        container = self._program.values[node.container]
        values = self._numbers.components(node.value)
        parts = tuple(
            self._between(value, container, axis, node, inside) for axis, value in enumerate(values)
        )
        index = self._nodes.conjunction(parts, inside)
        return self._nodes.negation(index, _shown(node)) if node.is_negated else index

    def _between(
        self, value: int, container: Value, axis: int, node: ast.Membership, inside: Shown
    ) -> int:
        ends = container.numbers[2 * axis : 2 * axis + 2]
        shown = self._numbers.shown(node.container)
        low, high = self._numbers.constant(container, ends, shown)
        if isinstance(container.type, Box):
            inside = Shown(f"{words(node.value.span)}.{_side(axis, ends, shown.unit)}", node.span)
        self._show_alike(value, node.container)
        return self._nodes.leaf(ir.Between(value, low, high), inside)

    def _oscillates(self, node: ast.Oscillates) -> int:
        swing = 0.0 if node.swing is None else self._program.values[node.swing].numbers[0]
        oscillates = ir.Oscillates(
            signal=self._numbers.scalar(node.value),
            count=int(node.count.value),
            window_ns=self._duration_ns(node.window),
            swing=swing,
        )
        return self._nodes.leaf(oscillates, _shown(node))

    def _query(self, node: ast.Oscillates | ast.Doing | ast.Call | ast.ListFold) -> int:
        if isinstance(node, ast.Doing):
            return self.skills.asked(node)
        return self._oscillates(node) if isinstance(node, ast.Oscillates) else self._call(node)

    def _call(self, node: ast.Call | ast.ListFold) -> int:
        if isinstance(node, ast.Call) and node.function.text == "changed":
            return self._changed(node)
        quantifier = ir.Quantifier(node.function.text)
        if isinstance(node, ast.Call):
            element = self._element(node.arguments[0])
        else:
            with self._numbers.elements_of(node):
                element = self._element(node.body)
        return self._nodes.leaf(ir.Quantified(quantifier, element), _shown(node))

    def _element(self, node: ast.Expression) -> int:
        """A condition on the elements of an array; named conditions are never part of it."""
        self._is_inside = True
        element = self._proposition(node, None)
        self._is_inside = False
        return element

    def _duration_ns(self, node: ast.Expression) -> int:
        return duration_ns(self._program.values[node])


def _side(axis: int, ends: tuple[float, ...], unit: Unit | None) -> str:
    """One side of a box, `x in [-0.8, 0.1] m`."""
    low, high = (end if unit is None else unit.from_si(end) for end in ends)
    symbol = "" if unit is None or unit == DIMENSIONLESS else f" {unit.symbol}"
    return f"{'xyz'[axis]} in [{low:.12g}, {high:.12g}]{symbol}"


def _shown(node: ast.Expression) -> Shown:
    return Shown(words(node.span), node.span)


def _operand(node: ast.Expression) -> str:
    """The words of an operand, in parentheses if they would otherwise be ambiguous."""
    text = words(node.span)
    is_one_word = isinstance(node, ast.Reference | ast.Member | ast.Call | ast.Parenthesized)
    return text if is_one_word else f"({text})"


def _parts(node: ast.Expression, operator: ast.BinaryOperator) -> tuple[ast.Expression, ...]:
    """The operands of a chain `a and b and c`, without recursion along the chain."""
    parts: list[ast.Expression] = []
    waiting = [node]
    while waiting:
        part = waiting.pop()
        inner = stripped(part)
        if isinstance(inner, ast.Binary) and inner.operator is operator:
            waiting += (inner.right, inner.left)
        else:
            parts.append(part)
    return tuple(parts)


def _arguments(node: ast.Expression) -> tuple[ast.Expression, ...]:
    inner = stripped(node)
    assert isinstance(inner, ast.Call), "asked before"
    return inner.arguments
