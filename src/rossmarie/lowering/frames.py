"""Vectors and orientations in another frame, as signals (S77, S78)."""

from __future__ import annotations

from collections.abc import Callable

from rossmarie import ir
from rossmarie.check.frames import CheckedFrame, FrameStep
from rossmarie.check.model import CheckedInput, CheckedProgram
from rossmarie.check.names.frames import frame_field, is_reported
from rossmarie.check.names.parts import MessagePart
from rossmarie.lowering.inputs import InputLowering, InputPart
from rossmarie.lowering.nodes import Nodes, Shown
from rossmarie.types import Quantity, Quaternion, Text, Vector
from rossmarie.units import DIMENSIONLESS, Unit, parse_unit

Axis = Callable[[int], int]
"""The signals of components by number, created on demand: a rule that uses x does not need y."""

_TURNED = (ir.Function.TURNED_X, ir.Function.TURNED_Y, ir.Function.TURNED_Z)
_COMPOSED = (
    ir.Function.COMPOSED_X,
    ir.Function.COMPOSED_Y,
    ir.Function.COMPOSED_Z,
    ir.Function.COMPOSED_W,
)
_UPRIGHT = (0.0, 0.0, 0.0, 1.0)
_METRE = parse_unit("m")


def is_in_frame(place: InputPart) -> bool:
    """Say whether the rules give the frame of a part of a message."""
    used = place.input
    return used.frame is not None and is_reported(used, place.path)


class FrameLowering:
    """Lowers transformations between frames."""

    def __init__(self, program: CheckedProgram, inputs: InputLowering, nodes: Nodes) -> None:
        self._program = program
        self._inputs = inputs
        self._nodes = nodes

    def seen(
        self, place: InputPart, type_: Vector | Quaternion, arrived: Axis, shown: Shown
    ) -> Axis:
        """The components of a vector or an orientation in the frame of the rules. `arrived` gives
        the components of the message.
        """
        used = place.input
        parts = self._in_source(place, arrived)
        if used.target is None or used.source is None:
            return parts
        path = self._program.frames.path(used.source, used.target)
        assert path is not None, "checked: there is a path"
        for leg in path:
            parts = self._along(leg, parts, type_, shown)
        return parts

    def frame(self, place: InputPart, shown: Shown) -> int:
        """The signal of the frame that the rules give for a part of a message, as a text."""
        used = place.input
        reported = frame_field(used.whole, place.path)
        if used.target is not None:
            return self._text(used.target, shown)
        if reported is not None:
            return self._reported(used, reported, shown)
        assert used.source is not None, "checked: somebody says the frame"
        return self._text(used.source, shown)

    # --- the frame of the message ------------------------------------------------------------

    def _in_source(self, place: InputPart, arrived: Axis) -> Axis:
        """The components of the message; unknown if the message has another frame (S77)."""
        used = place.input
        reported = frame_field(used.whole, place.path)
        if reported is None or used.source is None:
            return arrived
        source = used.source

        def seen(number: int) -> int:
            part = arrived(number)
            shown = self._shown(part)
            frame, wanted = self._reported(used, reported, shown), self._text(source, shown)
            return self._nodes.apply(ir.Function.SEEN, (part, frame, wanted), shown)

        return seen

    def _reported(self, used: CheckedInput, field: ir.Path, shown: Shown) -> int:
        place, name = InputPart(used, MessagePart(field)), Shown("frame", shown.span)
        if place.list_path is not None:
            return self._nodes.signal(ir.Element(self._inputs.column(place, Text())), name)
        return self._nodes.signal(ir.Read(self._inputs.slot(place, Text())), name)

    def _text(self, text: str, shown: Shown) -> int:
        return self._nodes.constant(float(self._inputs.text(text)), Shown(text, shown.span))

    def _shown(self, signal: int) -> Shown:
        found = self._nodes.signals[signal]
        return Shown(found.text, found.span, parse_unit(found.unit) if found.unit else None)

    # --- paths -------------------------------------------------------------------------------

    def _along(self, leg: FrameStep, parts: Axis, type_: Vector | Quaternion, shown: Shown) -> Axis:
        """The same vector or orientation in the frame at the end of a leg (S78)."""
        if isinstance(type_, Quaternion):
            return self._composed(leg, parts, shown)
        if not type_.is_position:
            return self._turned(leg, parts, type_.element.unit, shown)
        if leg.is_back:
            moved = self._moved(ir.Function.SUBTRACT, leg, parts, shown)
            return self._turned(leg, moved, _METRE, shown)
        turned = self._turned(leg, parts, _METRE, shown)
        return self._moved(ir.Function.ADD, leg, turned, shown)

    def _moved(self, function: ir.Function, leg: FrameStep, parts: Axis, shown: Shown) -> Axis:
        mounted = leg.frame.mounted
        if mounted is not None and not any(mounted[:3]):
            return parts
        named = _components(shown, "xyz", _METRE)
        return lambda n: self._nodes.apply(
            function, (parts(n), self._offset(leg.frame, n, shown)), named[n]
        )

    def _turned(self, leg: FrameStep, parts: Axis, unit: Unit | None, shown: Shown) -> Axis:
        if _is_upright(leg.frame):
            return parts
        named = _components(shown, "xyz", unit)
        return lambda n: self._nodes.apply(
            _TURNED[n], (*map(parts, range(3)), *self._turn(leg, shown)), named[n]
        )

    def _composed(self, leg: FrameStep, parts: Axis, shown: Shown) -> Axis:
        if _is_upright(leg.frame):
            return parts
        named = _components(shown, "xyzw", None)
        return lambda n: self._nodes.apply(
            _COMPOSED[n], (*self._turn(leg, shown), *map(parts, range(4))), named[n]
        )

    # --- transforms --------------------------------------------------------------------------

    def _offset(self, frame: CheckedFrame, number: int, shown: Shown) -> int:
        """One coordinate of the origin of a frame in its parent frame."""
        axis = "xyz"[number]
        if frame.mounted is not None:
            text = f"{axis} of {frame.name}"
            return self._nodes.constant(frame.mounted[number], Shown(text, shown.span, _METRE))
        return self._read(frame, "translation", axis, _METRE, shown)

    def _turn(self, leg: FrameStep, shown: Shown) -> tuple[int, ...]:
        """The rotation from one frame to the other; it is inverted if the leg leads backwards."""
        frame = leg.frame
        if frame.mounted is not None:
            *axes, w = frame.mounted[3:]
            numbers = (*((0.0 - each if leg.is_back else each) for each in axes), w)
            text = Shown(f"turn of {frame.name}", shown.span)
            return tuple(self._nodes.constant(each, text) for each in numbers)
        *about, last = (
            self._read(frame, "rotation", each, DIMENSIONLESS, shown) for each in "xyzw"
        )
        if not leg.is_back:
            return (*about, last)
        return (*(self._negative(each) for each in about), last)

    def _read(self, frame: CheckedFrame, field: str, axis: str, unit: Unit, shown: Shown) -> int:
        used = self._program.frame_inputs[frame.name]
        slot = self._inputs.slot(InputPart(used, MessagePart((field, axis))), Quantity(unit))
        text = f"{used.declaration.name.text}.{field}.{axis}"
        return self._nodes.signal(ir.Read(slot), Shown(text, shown.span, unit))

    def _negative(self, signal: int) -> int:
        found = self._shown(signal)
        text = Shown(f"-{found.text}", found.span, found.unit)
        return self._nodes.apply(ir.Function.NEGATE, (signal,), text)


def _is_upright(frame: CheckedFrame) -> bool:
    return frame.mounted is not None and frame.mounted[3:] == _UPRIGHT


def _components(shown: Shown, axes: str, unit: Unit | None) -> list[Shown]:
    return [Shown(f"{shown.text}.{axis}", shown.span, unit) for axis in axes]
