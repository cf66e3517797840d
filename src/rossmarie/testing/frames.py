"""The frames that rules ask for: where a test says nothing else, a message is in that frame."""

from __future__ import annotations

from collections.abc import Mapping

from rossmarie.core import Function, RegionFunction
from rossmarie.ir import Apply, Constant, Kind, Machine, Path, Read


def asked_frames(machine: Machine) -> Mapping[tuple[str, Path], str]:
    """The frame in which a position is asked for first, by the topic and the path of the field that
    tells its frame.
    """
    found: dict[tuple[str, Path], str] = {}
    for signal in machine.signals:
        match signal.node:
            case Apply(function=RegionFunction() | Function.SEEN, operands=(*_, seen, wanted)):
                field, text = machine.signals[seen].node, machine.signals[wanted].node
                if not isinstance(field, Read) or not isinstance(text, Constant):
                    continue
                slot = machine.slots[field.slot]
                topic = machine.channels[machine.inputs[slot.input].channel].topic
                if slot.kind is Kind.TEXT:
                    found.setdefault((topic, slot.path), machine.texts[int(text.value)])
            case _:  # open: nothing else has a frame
                pass
    return found
