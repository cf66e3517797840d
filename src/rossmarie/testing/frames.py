"""The frames that rules use. They are the default frames of messages in a test."""

from __future__ import annotations

from collections.abc import Mapping

from rossmarie.core import Function, RegionFunction
from rossmarie.ir import Apply, Constant, Element, FieldKind, Machine, Path, Read


def asked_frames(machine: Machine) -> Mapping[tuple[str, Path], str]:
    """The first frame in which a rule uses a position, by the topic and the path of the frame's
    field. The field belongs to the message, or to each element of a list.
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
                if reported.kind is FieldKind.TEXT:
                    found.setdefault((topic, reported.path), machine.texts[int(text.value)])
            case _:  # open: no other node has a frame
                pass
    return found
