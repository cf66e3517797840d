"""The frames that rules use: by default, a message in a test has this frame."""

from __future__ import annotations

from collections.abc import Mapping

from rossmarie.core import Function, RegionFunction
from rossmarie.ir import Apply, Constant, Element, Kind, Machine, Path, Read


def asked_frames(machine: Machine) -> Mapping[tuple[str, Path], str]:
    """The first frame in which a position is used, by the topic and the path of the field with its
    frame: a field of the message, or of each element of a list.
    """
    found: dict[tuple[str, Path], str] = {}
    for signal in machine.signals:
        match signal.node:
            case Apply(function=RegionFunction() | Function.SEEN, operands=(*_, seen, wanted)):
                field, text = machine.signals[seen].node, machine.signals[wanted].node
                if not isinstance(field, Read | Element) or not isinstance(text, Constant):
                    continue
                reported = (
                    machine.slots[field.slot]
                    if isinstance(field, Read)
                    else machine.arrays[field.array]
                )
                topic = machine.channels[machine.inputs[reported.input].channel].topic
                if reported.kind is Kind.TEXT:
                    found.setdefault((topic, reported.path), machine.texts[int(text.value)])
            case _:  # open: nothing else has a frame
                pass
    return found
