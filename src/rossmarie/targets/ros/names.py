"""All names that the generated package introduces, and the conversion of ROS names to C++."""

from __future__ import annotations

from collections.abc import Sequence

from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.targets.c99 import names
from rossmarie.targets.c99.layout import CLayout

_VARIABLES = ("host", "filtering", "made", "tasks")
_SHARING = (
    reactions.SetParameter | reactions.SwitchControllers | reactions.SendGoal | reactions.CancelGoal
)


def relative(name: str) -> str:
    """A name of the rules as C++: `/cmd_vel` as `"cmd_vel"`. ROS resolves it in the namespace of
    the node.
    """
    return names.string(name.removeprefix("/"))


def heard(channel: ir.Channel) -> str:
    """The topic of a channel as C++. Transforms arrive on the same topic in every namespace, as for
    every listener of tf2.
    """
    return relative(channel.topic) if channel.edge is None else names.string(channel.source)


def channel_classes(layout: CLayout) -> dict[int, str]:
    """The name of the struct for each channel that is a topic: `ImuDataChannel`."""
    channels = zip(layout.machine.channels, layout.channel_names, strict=True)
    return {
        index: f"{_capitalized(name)}Channel"
        for index, (channel, name) in enumerate(channels)
        if not ir.is_setting(channel)
    }


def command_members(machine: ir.Machine) -> tuple[str, ...]:
    """The name of the filter variable for each command topic: `cmd_vel`."""
    family = names.Family(taken=_VARIABLES)
    return tuple(family.name(command.topic) for command in machine.reactions.commands)


def command_classes(machine: ir.Machine) -> tuple[str, ...]:
    """The name of the struct for each command topic: `CmdVelCommand`."""
    return tuple(f"{_capitalized(member)}Command" for member in command_members(machine))


def hooks(machine: ir.Machine) -> dict[str, str]:
    """The function of each hook."""
    effects = (task.effect for task in machine.reactions.tasks)
    used = dict.fromkeys(effect.name for effect in effects if isinstance(effect, reactions.Hook))
    family = names.Family()
    return {name: family.name(name) for name in used}


def message_makers(machine: ir.Machine, tasks: Sequence[int]) -> dict[int, str]:
    """The name of the function that makes the message of each of these sending tasks."""
    family = names.Family("make_")
    return {
        task: family.name(machine.reactions.actions[machine.reactions.tasks[task].action].name)
        for task in tasks
    }


def shared(machine: ir.Machine) -> dict[int, str]:
    """The name of the object that a task shares with the other tasks of its target, by task."""
    family = names.Family(taken=(*_VARIABLES, *command_members(machine)))
    targets = [reactions.target_of(task.effect) for task in machine.reactions.tasks]
    objects = {target: family.name(str(target)) for target in dict.fromkeys(targets) if target}
    return {
        index: objects[target]
        for index, (task, target) in enumerate(zip(machine.reactions.tasks, targets, strict=True))
        if isinstance(task.effect, _SHARING) and target is not None
    }


def member(path: ir.Path) -> str:
    """A path into a message: `.twist.linear.x`, `.covariance.at(0)`."""
    return "".join(f".at({step})" if isinstance(step, int) else f".{step}" for step in path)


def _capitalized(word: str) -> str:
    """`cmd_vel_2` as `CmdVel_2`: digits keep their underscore, so that different words stay
    different.
    """
    parts = word.split("_")
    return "".join(part.capitalize() if part[:1].isalpha() else f"_{part}" for part in parts)
