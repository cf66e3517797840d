"""A machine as a catkin package: `generate` gives its files by name.

The input is a machine that `ir.verify` has accepted and for which `unsupported` found nothing.
"""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie import ir
from rossmarie.naming import node_name, unfiltered
from rossmarie.targets.manifest import Placement
from rossmarie.targets.ros.package import PackageWriter
from rossmarie.targets.ros1.dialect import ROS1

# The packages that the node itself uses.
_ALWAYS = {"roscpp", "std_msgs"}


def next_step(_: ir.Machine) -> str:
    """The build instructions of the package."""
    return "to build the package, run `catkin_make` in its ROS 1 workspace"


def generate(machine: ir.Machine, placement: Placement) -> dict[str, str]:
    """The files of the package, by their paths in it."""
    writer = PackageWriter(machine, ROS1, placement)
    package = node_name(machine)
    used = writer.packages() | _ALWAYS
    components = "\n  ".join(sorted(used))
    topics = [command.topic for command in machine.reactions.commands]
    remaps = [line for topic in topics for line in _remaps(topic)]
    return {
        **writer.own_package(used, components=components),
        **writer.needs(used),
        f"launch/{package}.launch": writer.fill("launch/safety.launch"),
        f"launch/{package}_robot.launch": writer.fill(
            "launch/robot.launch", remaps="\n".join(remaps)
        ),
        **writer.shared_files(),
    }


def _remaps(topic: str) -> Iterator[str]:
    """The lines that route the commands for a topic through the filter."""
    pair = (topic, unfiltered(topic))
    for sent, behind in (tuple(name.removeprefix("/") for name in pair), map(_in_namespace, pair)):
        yield f'    <remap from="{sent}" to="{behind}"/>'


def _in_namespace(topic: str) -> str:
    """A topic with the namespace of the launch file."""
    return f"$(eval ('/' + arg('namespace').strip('/')).rstrip('/') + '{topic}')"
