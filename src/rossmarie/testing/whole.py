"""Fields of whole numbers: the values that what rests on them can have, and what tests may set."""

from __future__ import annotations

import math
from collections.abc import Iterator

from rossmarie import ir
from rossmarie.ir import Function
from rossmarie.ir.carried import carries
from rossmarie.ir.script import Script, ScriptedArrival, Setting


def whole_step(machine: ir.Machine, signal: int) -> float | None:
    """The distance, in SI, between neighbors among the values of a signal that can only have some;
    None if it may have any.
    """
    match machine.signals[signal].node:
        case ir.Count():
            return 1.0
        case ir.Read(slot=slot):
            return _step_of(machine.slots[slot])
        case ir.Element(array=array):
            return _step_of(machine.arrays[array])
        case ir.Previous(signal=inner) | ir.Fold(element=inner):
            return whole_step(machine, inner)
        case ir.Apply(function=function, operands=operands):
            return _applied(machine, function, operands)
        case ir.Constant() | ir.Rate():
            return None


def _step_of(source: ir.Slot | ir.Array) -> float | None:
    return None if source.limits is None else abs(source.scale)


def _applied(machine: ir.Machine, function: Function, operands: tuple[int, ...]) -> float | None:
    nodes = [machine.signals[operand].node for operand in operands]
    constants = [node.value for node in nodes if isinstance(node, ir.Constant)]
    steps = [
        whole_step(machine, operand)
        for operand, node in zip(operands, nodes, strict=True)
        if not isinstance(node, ir.Constant)
    ]
    known = [step for step in steps if step is not None]
    if not known or len(known) < len(steps):
        return None
    match function:
        case Function.NEGATE | Function.ABSOLUTE:
            return min(known)
        case Function.ADD | Function.SUBTRACT | Function.MINIMUM | Function.MAXIMUM:
            return min(known) if _is_one(known) else None
        case Function.MULTIPLY:
            is_scaled = len(constants) == 1 and constants[0]
            return _representable(known[0] * abs(constants[0])) if is_scaled else None
        case Function.DIVIDE:
            is_scaled = isinstance(nodes[1], ir.Constant) and constants[0]
            return _representable(known[0] / abs(constants[0])) if is_scaled else None
        case Function.NORM | Function.ROLL | Function.PITCH | Function.YAW:
            return None


def _representable(step: float) -> float | None:
    """None if it is beyond the range of a double, or too small for one."""
    return step if 0.0 < step < math.inf else None


def _is_one(steps: list[float]) -> bool:
    """Whether each step is a multiple of the least."""
    ratios = [step / min(steps) for step in steps]
    return all(math.isclose(ratio, round(ratio)) for ratio in ratios)


def slot_behind(machine: ir.Machine, sampled: int) -> int | None:
    """The slot whose samples a rate or a previous sample takes; None if it takes others."""
    node = machine.signals[sampled].node
    signal = node.signal if isinstance(node, ir.Rate | ir.Previous) else sampled
    read = machine.signals[signal].node
    return read.slot if isinstance(read, ir.Read) else None


# --- scripts ---------------------------------------------------------------------------------


def is_carried(machine: ir.Machine, script: Script) -> bool:
    """Whether messages can carry all that a script sets."""
    sources: list[ir.Slot | ir.Array] = [*machine.slots, *machine.arrays]
    fields = {
        (machine.channels[machine.inputs[each.input].channel].topic, each.path): each
        for each in sources
    }
    for setting in _settings(script):
        source = fields.get((setting.topic, setting.path))
        values = setting.value if isinstance(setting.value, tuple) else (setting.value,)
        numbers = [value for value in values if isinstance(value, float)]
        if source is not None and not all(carries(source, number) for number in numbers):
            return False
    return True


def _settings(script: Script) -> Iterator[Setting]:
    for event in script.events:
        if isinstance(event, ScriptedArrival):
            yield from event.settings
