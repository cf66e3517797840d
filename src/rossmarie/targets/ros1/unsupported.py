"""Limits of the ROS 1 target, and of its core."""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import Diagnostic
from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.naming import effect_words
from rossmarie.targets import c99
from rossmarie.targets.errors import NothingToDo, UnsupportedEffect


def unsupported(machine: ir.Machine) -> Iterator[Diagnostic]:
    """A finding for every feature that the generated node would have to leave out."""
    yield from c99.unsupported(machine)
    if machine.rules and not machine.reactions.tasks:
        yield NothingToDo(target="ros1").at(machine.rules[0].span)
    for task in machine.reactions.tasks:
        effect = task.effect
        if isinstance(effect, reactions.SetParameter) and "." in effect.parameter:
            finding = UnsupportedEffect(
                target="ros1",
                effect=effect_words(machine, effect),
                reason="the name of a dynamic_reconfigure parameter cannot contain dots",
            )
            yield finding.at(task.span, help=finding.OtherParameter())
