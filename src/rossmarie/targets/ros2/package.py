"""A machine as an ament package: `generate` gives its files by name.

The input is a machine that `ir.verify` has accepted and for which `unsupported` found nothing.
"""

from __future__ import annotations

from rossmarie import ir
from rossmarie.naming import node_name, relayed_servers, unfiltered
from rossmarie.targets.manifest import Placement
from rossmarie.targets.ros.package import PackageWriter
from rossmarie.targets.ros2 import security
from rossmarie.targets.ros2.dialect import ROS2

# The suffixes of the name of an action server: ROS 2 renames topics and services, not actions.
_OF_ACTIONS = ("send_goal", "cancel_goal", "get_result", "feedback", "status")

# The packages that the node itself uses.
_ALWAYS = {
    "bondcpp", "builtin_interfaces", "lifecycle_msgs", "rcl_interfaces", "rclcpp",
    "rclcpp_components", "rclcpp_lifecycle", "std_msgs",
}  # fmt: skip


def next_step(machine: ir.Machine) -> str:
    """The build instructions of the package."""
    package = node_name(machine)
    command = f"colcon build --packages-select {package}"
    return f"to build the package, run `{command}` in its ROS 2 workspace"


def generate(machine: ir.Machine, placement: Placement) -> dict[str, str]:
    """The files of the package, by their paths in it."""
    writer = PackageWriter(machine, ROS2, placement)
    package = node_name(machine)
    used = writer.packages() | _ALWAYS
    remaps = [f"    '{source}': '{front}'," for source, front in _remappings(machine).items()]
    return {
        **writer.own_package(used),
        **writer.needs(used),
        f"launch/{package}.launch.py": writer.fill(
            "launch/safety.launch.py", remaps="\n".join(remaps)
        ),
        "security/policy.xml": security.policy(machine),
        "src/component.cpp": writer.fill("src/component.cpp"),
        **writer.shared_files(),
    }


def _remappings(machine: ir.Machine) -> dict[str, str]:
    """The names of commands and goals, and the names at which they enter the node."""
    topics = (command.topic for command in machine.reactions.commands)
    found = {topic: unfiltered(topic) for topic in topics}
    for server in relayed_servers(machine):
        for each in _OF_ACTIONS:
            found[f"{server}/_action/{each}"] = f"{unfiltered(server)}/_action/{each}"
    return found
