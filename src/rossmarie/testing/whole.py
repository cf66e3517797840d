"""Fields of whole numbers: the possible values of expressions over them, and the values that tests
may set.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from rossmarie import ir
from rossmarie.core import AnyFunction, SampleNumber, defined, sampling_row
from rossmarie.core.expressions import (
    Applied,
    Chosen,
    Computed,
    ConstantNumber,
    Expression,
    Local,
    Operand,
    Primitive,
)
from rossmarie.ir.carried import carries
from rossmarie.ir.script import FieldValue, Script, ScriptedArrival

_PLAIN = frozenset({SampleNumber.SECONDS, SampleNumber.COUNT, SampleNumber.CONSTANT})
"""Views that are not samples, and can be any number."""


def whole_step(machine: ir.Machine, signal: int) -> float | None:
    """The distance, in SI, between neighbors among the possible values of a signal; None if the
    signal can have any value.
    """
    match machine.signals[signal].node:
        case ir.Count():
            return 1.0
        case ir.Read(slot=slot):
            return _step_of(machine.slots[slot])
        case ir.Element(array=array):
            return _step_of(machine.arrays[array])
        case ir.Fold(element=inner):
            return whole_step(machine, inner)
        case ir.Sampled(function=sampling, signal=inner):
            declared = sampling_row(sampling)
            step = whole_step(machine, inner)
            known = [None if view in _PLAIN else step for view in declared.views]
            return _Steps(known, [None] * len(known)).of(declared.expression)
        case ir.Apply(function=function, operands=operands):
            return _applied(machine, function, operands)
        case ir.Constant():
            return None


def _step_of(source: ir.Slot | ir.Array) -> float | None:
    return None if source.limits is None else abs(source.scale)


def _applied(machine: ir.Machine, function: AnyFunction, operands: tuple[int, ...]) -> float | None:
    nodes = [machine.signals[operand].node for operand in operands]
    constants = [each.value if isinstance(each, ir.Constant) else None for each in nodes]
    steps = [whole_step(machine, operand) for operand in operands]
    return _Steps(steps, constants).of(defined(function, len(operands)))


class _Steps:
    """The distances between the possible values of expressions; None for operands with any
    value.
    """

    def __init__(self, steps: Sequence[float | None], constants: Sequence[float | None]) -> None:
        self._steps, self._constants = steps, constants

    def of(self, expression: Expression) -> float | None:
        match expression:
            case ConstantNumber() | Applied():
                return None
            case Operand(index=index):
                return self._steps[index]
            case Local(value=value):
                return self.of(value)
            case Chosen(then=then, otherwise=otherwise):
                return self._together((then, otherwise))
            case Computed(primitive=primitive, operands=operands):
                return self._computed(primitive, operands)

    def _computed(self, primitive: Primitive, operands: tuple[Expression, ...]) -> float | None:
        match primitive:
            case Primitive.NEGATE | Primitive.ABSOLUTE:
                return self.of(operands[0])
            case Primitive.ADD | Primitive.SUBTRACT:
                return self._together(operands)
            case Primitive.MULTIPLY:
                pairs = (operands, operands[::-1])
                found = [self._scaled(self.of(one), self._constant(by)) for one, by in pairs]
                return found[0] or found[1]
            case Primitive.DIVIDE:
                step, by = self.of(operands[0]), self._constant(operands[1])
                return _representable(step / abs(by)) if step and by else None
            case Primitive.SQUARE_ROOT:
                return None

    def _constant(self, expression: Expression) -> float | None:
        match expression:
            case ConstantNumber(value=value):
                return value
            case Operand(index=index):
                return self._constants[index]
            case Computed() | Applied() | Chosen() | Local():
                return None

    def _scaled(self, step: float | None, factor: float | None) -> float | None:
        return _representable(step * abs(factor)) if step and factor else None

    def _together(self, parts: tuple[Expression, ...]) -> float | None:
        """The step of a sum, or of a choice among several numbers. Constants only shift the
        values.
        """
        steps = [self.of(part) for part in parts if self._constant(part) is None]
        known = [step for step in steps if step is not None]
        is_whole = known and len(known) == len(steps) and _is_one(known)
        return min(known) if is_whole else None


def _representable(step: float) -> float | None:
    """The step; None if it is beyond the range of a double, or too small for a double."""
    return step if 0.0 < step < math.inf else None


def _is_one(steps: list[float]) -> bool:
    """Say whether each step is a multiple of the least step."""
    ratios = [step / min(steps) for step in steps]
    return all(math.isclose(ratio, round(ratio)) for ratio in ratios)


def slot_behind(machine: ir.Machine, sampled: int) -> int | None:
    """The slot whose samples a rate or a previous sample uses; None if it uses other samples."""
    node = machine.signals[sampled].node
    signal = node.signal if isinstance(node, ir.Sampled) else sampled
    read = machine.signals[signal].node
    return read.slot if isinstance(read, ir.Read) else None


# --- scripts ---------------------------------------------------------------------------------


def is_carried(machine: ir.Machine, script: Script) -> bool:
    """Say whether messages can carry all values that a script sets."""
    sources: list[ir.Slot | ir.Array] = [*machine.slots, *machine.arrays]
    fields = {
        (machine.channels[machine.inputs[each.input].channel].topic, each.path): each
        for each in sources
    }
    for setting in _settings(script):
        source = fields.get((setting.topic, _field_of(setting, machine)))
        values = setting.value if isinstance(setting.value, tuple) else (setting.value,)
        numbers = [value for value in values if isinstance(value, float)]
        if source is not None and not all(carries(source, number) for number in numbers):
            return False
    return True


def _field_of(setting: FieldValue, machine: ir.Machine) -> ir.Path:
    """The path of the set field, with the index in a list replaced by `EACH`."""
    for each in machine.lists:
        size = len(each.path)
        if setting.path[:size] == each.path and len(setting.path) > size:
            return (*each.path, ir.EACH, *setting.path[size + 1 :])
    return setting.path


def _settings(script: Script) -> Iterator[FieldValue]:
    for event in script.events:
        if isinstance(event, ScriptedArrival):
            yield from event.settings
