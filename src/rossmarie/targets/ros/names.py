"""All names that the generated package invents, and how ROS names become C++."""

from __future__ import annotations

from collections.abc import Sequence

from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.targets.c99 import names
from rossmarie.targets.c99.layout import Layout

_VARIABLES = ("host", "filtering", "made", "tasks")
_SHARING = (
    reactions.SetParameter | reactions.SwitchControllers | reactions.SendGoal | reactions.CancelGoal
)


def relative(name: str) -> str:
    """A name of the rules as C++: `/cmd_vel` as `"cmd_vel"`, which ROS resolves in the namespace of
    the node.
    """
    return names.string(name.removeprefix("/"))


def heard(channel: ir.Channel) -> str:
    """The topic of a channel as C++. Transforms come on one topic, whatever namespace the node is
    in, as for every listener of tf2.
    """
    return relative(channel.topic) if channel.edge is None else names.string(channel.source)


def channel_classes(layout: Layout) -> tuple[str, ...]:
    """For each input topic the struct that describes it: `ImuDataChannel`."""
    return tuple(f"{_capitalized(name)}Channel" for name in layout.channel_names)


def command_members(machine: ir.Machine) -> tuple[str, ...]:
    """For each command topic the variable of its filter: `cmd_vel`."""
    family = names.Family(taken=_VARIABLES)
    return tuple(family.name(command.topic) for command in machine.reactions.commands)


def command_classes(machine: ir.Machine) -> tuple[str, ...]:
    """For each command topic the struct that describes it: `CmdVelCommand`."""
    return tuple(f"{_capitalized(member)}Command" for member in command_members(machine))


def hooks(machine: ir.Machine) -> dict[str, str]:
    """For each hook its function."""
    effects = (task.effect for task in machine.reactions.tasks)
    used = dict.fromkeys(effect.name for effect in effects if isinstance(effect, reactions.Hook))
    family = names.Family()
    return {name: family.name(name) for name in used}


def message_makers(machine: ir.Machine, tasks: Sequence[int]) -> dict[int, str]:
    """For each of the tasks that send something the function that makes it."""
    family = names.Family("make_")
    return {
        task: family.name(machine.reactions.actions[machine.reactions.tasks[task].action].name)
        for task in tasks
    }


def shared(machine: ir.Machine) -> dict[int, str]:
    """For each task that shares an object with the others of its target, that object."""
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
    """`cmd_vel_2` as `CmdVel_2`: digits keep their line, so that different words stay different."""
    parts = word.split("_")
    return "".join(part.capitalize() if part[:1].isalpha() else f"_{part}" for part in parts)
