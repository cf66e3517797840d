"""Limits of the ROS 2 target, and of its core."""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import Diagnostic
from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.naming import effect_words, relayed_servers
from rossmarie.targets import c99
from rossmarie.targets.errors import NothingToDo, UnsupportedEffect


def unsupported(machine: ir.Machine) -> Iterator[Diagnostic]:
    """A finding for every feature that the generated node would have to leave out."""
    yield from c99.unsupported(machine)
    if machine.rules and not machine.reactions.tasks:
        yield NothingToDo(target="ros2").at(machine.rules[0].span)
    for task in machine.reactions.tasks:
        match task.effect:
            case reactions.CancelGoal(server=server, interrupted=reactions.Interrupted.RESEND) if (
                server not in relayed_servers(machine)
            ):
                finding = UnsupportedEffect(
                    target="ros2",
                    effect=f"{effect_words(machine, task.effect)} then resend",
                    reason="ROS 2 can send a goal again only if its type is known",
                )
                yield finding.at(task.span, help=finding.StateType(server=server))
            case (
                reactions.Limit() | reactions.Scale() | reactions.Publish()
                | reactions.Retrace() | reactions.Call() | reactions.SetParameter()
                | reactions.SwitchControllers() | reactions.SendGoal() | reactions.CancelGoal()
                | reactions.Log() | reactions.Diagnose() | reactions.Hook() | reactions.Reset()
            ):  # fmt: skip
                pass
