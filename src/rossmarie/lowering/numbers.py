"""Numeric expressions: scalars, vectors, orientations, and the elements of arrays.

Types and units have been checked. An array stands for any of its elements: the checker allows an
array only inside a fold, a count or a quantifier.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import replace
from typing import TypeGuard

from rossmarie import ir
from rossmarie.check.model import CheckedMotion, CheckedProgram, Value
from rossmarie.check.operations.lists import counts_all
from rossmarie.check.scopes.trees import stripped
from rossmarie.core import RegionFunction, RegionMeasure, sampling_row
from rossmarie.lowering.beams import ANGLE, coordinate, is_of_point
from rossmarie.lowering.braking import stopping_distance
from rossmarie.lowering.durations import duration_ns
from rossmarie.lowering.frames import Axis, FrameLowering, is_in_frame
from rossmarie.lowering.inputs import InputLowering, InputPart
from rossmarie.lowering.nodes import Nodes, Shown
from rossmarie.lowering.places import PartPlaces
from rossmarie.lowering.wording import unit_of, words
from rossmarie.syntax import ast
from rossmarie.types import (
    Array,
    Boolean,
    Box,
    Entry,
    Interval,
    List,
    Message,
    Motion,
    Point,
    Quantity,
    Quaternion,
    Region,
    Text,
    Type,
    Unknown,
    Unsupported,
    Vector,
)

_ARITHMETIC = {
    ast.BinaryOperator.ADD: ir.Function.ADD,
    ast.BinaryOperator.SUBTRACT: ir.Function.SUBTRACT,
    ast.BinaryOperator.MULTIPLY: ir.Function.MULTIPLY,
    ast.BinaryOperator.DIVIDE: ir.Function.DIVIDE,
}

_EACH = {
    "abs": ir.Function.ABSOLUTE,
    "hypot": ir.Function.HYPOT,
    "sin": ir.Function.SINE,
    "cos": ir.Function.COSINE,
}
"""Functions that apply to each component, or to each element."""

_WHOLE = {
    each.value: each
    for each in (ir.Function.NORM, ir.Function.ROLL, ir.Function.PITCH, ir.Function.YAW)
}
"""Functions that apply to all components of one argument together."""

_FOLDINGS = {"min": ir.Folding.MINIMUM, "max": ir.Folding.MAXIMUM}

Components = tuple[int, ...]
"""The signals of a scalar (one), a vector (x, y, z) or an orientation (x, y, z, w)."""


class NumberLowering:
    """Lowers numeric expressions of one program. `count` needs conditions, which `truth` lowers."""

    def __init__(
        self,
        program: CheckedProgram,
        inputs: InputLowering,
        nodes: Nodes,
        proposition: Callable[[ast.Expression], int],
    ) -> None:
        self._program = program
        self._inputs = inputs
        self._nodes = nodes
        self._proposition = proposition
        self._frames = FrameLowering(program, inputs, nodes)
        self._places = PartPlaces(program)

    def scalar(self, node: ast.Expression) -> int:
        """The signal of a number, of a text, or of any one element of an array."""
        (signal,) = self.components(node)
        return signal

    def components(self, node: ast.Expression) -> Components:
        """The signals of a number, a vector or an orientation."""
        constant = self._program.values.get(node)
        if constant is not None:
            return self.constant(constant, constant.numbers, self.shown(node))
        place = self.place(node)
        if place is not None and self._is_component(node, place):
            return (self._component(node),)
        if place is not None:
            found = self._read(place, self.type_of(node), self.shown(node))
            setting = place.input.declaration.setting
            return found if setting is None else self._setting(found, setting, self.shown(node))
        match node:
            case ast.Parenthesized(inner=inner):
                return self.components(inner)
            case ast.Unary(operand=operand):
                return self._each(ir.Function.NEGATE, (self.components(operand),), node)
            case ast.Binary():
                return self._arithmetic(node)
            case ast.Member(value=value, member=member):
                return (self.components(value)["xyzw".index(member.text)],)
            case ast.Call():
                return self._call(node)
            case ast.ListFold():
                return (self._folded_list(node),)
            case (
                ast.Number() | ast.Boolean() | ast.Text() | ast.Bracket() | ast.Reference()
                | ast.Index() | ast.Sector() | ast.Edges() | ast.Oscillates() | ast.Membership()
                | ast.Held() | ast.Since()
                | ast.Once() | ast.Response() | ast.Doing() | ast.Broken()
            ):  # fmt: skip
                raise AssertionError(f"checked: {type(node).__name__} is no number")

    def _setting(self, given: Components, setting: ast.Constant, shown: Shown) -> Components:
        """A parameter of the node: the given value, if it is tighter than the default (S87)."""
        assert setting.parameter is not None
        is_up = setting.parameter.tightens is not None and setting.parameter.tightens.text == "up"
        (usual,) = self._program.values[setting.value].numbers
        far = ir.farthest(usual, is_up=is_up)
        operands = *given, self._nodes.constant(usual, shown), self._nodes.constant(far, shown)
        function = ir.Function.RAISED if is_up else ir.Function.LOWERED
        return (self._nodes.apply(function, operands, shown),)

    def constant(self, value: Value, numbers: tuple[float, ...], shown: Shown) -> Components:
        """The signals of a constant: its numbers, or the index of its text."""
        if value.text is not None:
            return (self._nodes.constant(float(self._inputs.text(value.text)), shown),)
        return tuple(self._nodes.constant(number, shown) for number in numbers)

    def type_of(self, node: ast.Expression) -> Type:
        """The type from the checker."""
        return self._program.types[node]

    def pose(self, node: ast.Expression) -> Components:
        """The signals of a position, or of a position and an orientation."""
        type_, place, shown = self.type_of(node), self.place(node), self.shown(node)
        if not isinstance(type_, Message) or place is None:
            return self.components(node)
        found: Components = ()
        for name in ("position", "orientation"):
            part = type_.fields[name]
            words_of_it = replace(shown, text=f"{shown.text}.{name}")
            found += self._read(place.field(name, part), part, words_of_it)
        return found

    # --- parts of messages -------------------------------------------------------------------

    def place(self, node: ast.Expression) -> InputPart | None:
        """The part of a message that an expression names; None if it names something else."""
        return self._places.place(node)

    def elements_of(self, node: ast.ListFold) -> AbstractContextManager[None]:
        """A context in which the variable of a fold is the current element of its list."""
        return self._places.elements_of(node)

    def _read(self, place: InputPart, type_: Type, shown: Shown) -> Components:
        match type_:
            case Message(fields=fields):
                # For a std_msgs message, its data is used.
                data = fields["data"]
                return self._read(
                    place.field("data", data), data, replace(shown, unit=unit_of(data))
                )
            case Vector() | Quaternion():
                return self._read_vector(place, type_, shown)
            case Array():
                array = self._inputs.array(place, type_)
                return (self._nodes.signal(ir.Element(array), shown),)
            case (
                Boolean() | Text() | Quantity() | List() | Interval() | Box() | Region() | Motion()
                | Entry() | Unsupported() | Unknown()
            ):  # fmt: skip
                return (self._read_scalar(place, type_, shown),)

    def _is_component(self, node: ast.Expression, place: InputPart) -> TypeGuard[ast.Member]:
        """Say whether a part of a message is a component of a quantity with a known frame. The
        whole quantity is needed then.
        """
        if not isinstance(node, ast.Member) or not is_in_frame(place):
            return False
        if node.member.text not in ("x", "y", "z", "w"):
            return False  # e.g. the range of a point of a scan, which is the same in all frames
        return isinstance(self.type_of(node.value), Vector | Quaternion)

    def _component(self, node: ast.Member) -> int:
        place, type_ = self.place(node.value), self.type_of(node.value)
        assert place is not None, "a component is of a part of a message"
        assert isinstance(type_, Vector | Quaternion), "checked: it has components"
        parts = self._seen(place, type_, self.shown(node.value))
        return parts("xyzw".index(node.member.text))

    def _read_vector(
        self, place: InputPart, type_: Vector | Quaternion, shown: Shown
    ) -> Components:
        parts = self._seen(place, type_, shown)
        return tuple(map(parts, range(3 if isinstance(type_, Vector) else 4)))

    def _seen(self, place: InputPart, type_: Vector | Quaternion, shown: Shown) -> Axis:
        """The components of a vector or an orientation, in the frame of the rules."""
        element = type_.element if isinstance(type_, Vector) else Quantity(None)

        def arrived(number: int) -> int:
            return self._read_part(place, "xyzw"[number], element, shown)

        return self._frames.seen(place, type_, arrived, shown) if is_in_frame(place) else arrived

    def _read_part(self, place: InputPart, axis: str, element: Quantity, shown: Shown) -> int:
        part = Shown(f"{shown.text}.{axis}", shown.span, element.unit)
        return self._read_scalar(place.field(axis, element), element, part)

    def _read_scalar(self, place: InputPart, type_: Type, shown: Shown) -> int:
        """One number, flag or text of the message, or of the current element."""
        if isinstance(type_, Quantity) and is_of_point(place):
            return coordinate(place, type_, shown, self._inputs, self._nodes)
        if place.list_path is not None:
            return self._nodes.signal(ir.Element(self._inputs.column(place, type_)), shown)
        return self._nodes.signal(ir.Read(self._inputs.slot(place, type_)), shown)

    # --- elements of lists -------------------------------------------------------------------

    def _folded_list(self, node: ast.ListFold) -> int:
        with self.elements_of(node):
            if counts_all(node, self._program.types, self._program.values):
                folded: ir.SignalNode = ir.Count(self._is_there(node))
            elif node.function.text == "count":
                folded = ir.Count(self._proposition(node.body))
            else:
                folded = ir.Fold(_FOLDINGS[node.function.text], self.scalar(node.body))
        return self._nodes.signal(folded, self.shown(node))

    def _is_there(self, node: ast.ListFold) -> int:
        """The proposition that is true for each beam of a scan, and for each point of a cloud.
        Points without a position do not count.
        """
        points = self.type_of(node.list)
        assert isinstance(points, List), "checked: it is the points of a cloud, or beams"
        name = node.variable.text
        shown, element = Shown(name, node.body.span), points.element
        field, type_ = ("x", element.element) if isinstance(element, Point) else ("angle", ANGLE)
        x = self._read_part(self._places.element(name), field, type_, shown)
        is_number = ir.Compare(ir.Comparison.EQUAL, x, x)
        return self._nodes.leaf(is_number, self.shown(node.body))

    # --- operators ---------------------------------------------------------------------------

    def _arithmetic(self, node: ast.Binary) -> Components:
        """A chain `a + b - c` from left to right, without recursion along the chain."""
        chain: list[ast.Binary] = []
        first: ast.Expression = node
        while isinstance(first, ast.Binary) and first not in self._program.values:
            chain.append(first)
            first = first.left
        result = self.components(first)
        for link in reversed(chain):
            operands = _spread(result, self.components(link.right))
            result = self._each(_ARITHMETIC[link.operator], operands, link)
        return result

    def _each(
        self, function: ir.Function, operands: tuple[Components, ...], node: ast.Expression
    ) -> Components:
        """A function of each component."""
        parts = zip(*operands, strict=True)
        shown = self.shown(node)
        return tuple(self._nodes.apply(function, part, shown) for part in parts)

    # --- functions ---------------------------------------------------------------------------

    def _call(self, node: ast.Call) -> Components:
        shown = self.shown(node)
        name = node.function.text
        arguments = node.arguments
        match name:
            case "previous":
                parts = self.components(arguments[0])
                return tuple(self._sampled(node, part, shown) for part in parts)
            case "rate" | "median" | "mean" | "low_pass":
                return (self._sampled(node, self.scalar(arguments[0]), shown),)
            case "abs" | "hypot" | "sin" | "cos":
                return self._each(_EACH[name], tuple(map(self.components, arguments)), node)
            case "min" | "max":
                return (self._extreme(node, shown),)
            case "count":
                return (self._nodes.signal(ir.Count(self._proposition(arguments[0])), shown),)
            case "norm" | "roll" | "pitch" | "yaw":
                parts = self.components(arguments[0])
                return (self._nodes.apply(_WHOLE[name], parts, shown),)
            case "braking_distance" | "time_to":
                parts = tuple(map(self.scalar, arguments))
                return (self._nodes.apply(ir.Function(name), parts, shown),)
            case "distance":
                return (self._distance(node, shown),)
            case "stopping":
                return (self._stopping(node, shown),)
            case _:
                raise AssertionError(f"checked: {name} is no function to a number")

    def previous(self, node: ast.Expression) -> Components:
        """The components of an expression at the previous sample."""
        shown = self.shown(node)
        before = replace(shown, text=f"previous({shown.text})")
        parts = self.components(node)
        return tuple(self._nodes.signal(ir.Sampled(ir.Sampling.PREVIOUS, x), before) for x in parts)

    def _sampled(self, node: ast.Call, signal: int, shown: Shown) -> int:
        function = ir.Sampling(node.function.text)
        window_ns = 0
        if sampling_row(function).takes_time:
            window_ns = duration_ns(self._program.values[node.arguments[1]])
        return self._nodes.signal(ir.Sampled(function, signal, window_ns), shown)

    def _extreme(self, node: ast.Call, shown: Shown) -> int:
        is_minimum = node.function.text == "min"
        if len(node.arguments) == 1:
            folding = _FOLDINGS[node.function.text]
            return self._nodes.signal(ir.Fold(folding, self.scalar(node.arguments[0])), shown)
        function = ir.Function.MINIMUM if is_minimum else ir.Function.MAXIMUM
        first, *rest = (self.scalar(argument) for argument in node.arguments)
        for other in rest:
            first = self._nodes.apply(function, (first, other), shown)
        return first

    def of_named_region(
        self, measure: RegionMeasure, position: ast.Expression, region: ast.Expression, shown: Shown
    ) -> int:
        """The signal of a function of the region that a class stands for."""
        type_ = self.type_of(region)
        assert isinstance(type_, Region), "checked: it is a region"
        function = RegionFunction(measure, self._program.regions[stripped(region)])
        wanted = Shown(type_.frame, region.span)
        return self.of_region(function, position, wanted, shown)

    def of_region(
        self, function: RegionFunction, position: ast.Expression, wanted: Shown, shown: Shown
    ) -> int:
        """The signal of a function of a position or a pose in the frame `wanted` (S63, S64)."""
        place, seen = self.place(position), self.type_of(position)
        assert place is not None, "checked: the frame of the position is known"
        if isinstance(seen, Message):
            seen = seen.fields["position"]
            place = place.field("position", seen)
        assert isinstance(seen, Vector), "checked: it is a position"
        words_of_it = self.shown(position)
        parts = self._seen(place, seen, words_of_it)
        x, y = parts(0), parts(1)
        frame = self._frames.frame(place, words_of_it)
        text = self._nodes.constant(float(self._inputs.text(wanted.text)), wanted)
        return self._nodes.apply(function, (x, y, frame, text), shown)

    def _distance(self, node: ast.Call, shown: Shown) -> int:
        if stripped(node.arguments[1]) in self._program.regions:
            position, container = node.arguments
            return self.of_named_region(RegionMeasure.DISTANCE, position, container, shown)
        left, right = (self.components(argument) for argument in node.arguments)
        pairs = zip(left, right, strict=True)
        gaps = tuple(self._nodes.apply(ir.Function.SUBTRACT, pair, shown) for pair in pairs)
        return self._nodes.apply(ir.Function.NORM, gaps, shown)

    def _stopping(self, node: ast.Call, shown: Shown) -> int:
        named, *speeds = node.arguments
        type_ = self.type_of(named)
        assert isinstance(type_, Motion), "checked: it is a motion"
        wanted = self._program.values[speeds[0]].numbers[0] if speeds else 0.0
        return self.stopping_distance(self._program.motions[type_.name], wanted, shown)

    def stopping_distance(self, motion: CheckedMotion, wanted: float, shown: Shown) -> int:
        """The greatest distance in m in which a motion slows down to a speed (S65)."""
        return stopping_distance(self.scalar(motion.speed), motion, wanted, shown, self._nodes)

    # --- how it is shown ---------------------------------------------------------------------

    def shown(self, node: ast.Expression) -> Shown:
        """The words, the place and the unit of an expression."""
        return Shown(words(node.span), node.span, unit_of(self._program.types[node]))


def _spread(left: Components, right: Components) -> tuple[Components, Components]:
    """The operands with equal numbers of components: a scalar is repeated for each component of a
    vector.
    """
    size = max(len(left), len(right))
    return (left * (size if len(left) == 1 else 1), right * (size if len(right) == 1 else 1))
