"""The names of the generated node for other nodes, and the names at which commands and goals enter
it.
"""

from __future__ import annotations

from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.naming.identifiers import public_prefix

_UNFILTERED = "unfil_"


def node_name(machine: ir.Machine) -> str:
    """The name of the node and its package. Its ending distinguishes it from packages with the name
    of the rules file, and from the C names.
    """
    return f"{public_prefix(machine.name).rstrip('_')}_safety"


def unfiltered(name: str) -> str:
    """The unfiltered counterpart of a topic or an action server: `/robot/unfil_cmd_vel`."""
    head, slash, tail = name.rpartition("/")
    return f"{head}{slash}{_UNFILTERED}{tail}"


def relayed_servers(machine: ir.Machine) -> dict[str, str]:
    """The action servers whose interrupted goals are sent again, with their types."""
    found = {}
    for task in machine.reactions.tasks:
        match task.effect:
            case (
                reactions.SendGoal(server=server, action_type=str(action_type))
                | reactions.CancelGoal(server=server, action_type=str(action_type))
            ) if task.effect.interrupted is reactions.Interrupted.RESEND:
                found[server] = action_type
            case (
                reactions.Limit() | reactions.Scale() | reactions.Publish()
                | reactions.Retrace() | reactions.Call() | reactions.SetParameter()
                | reactions.SwitchControllers() | reactions.SendGoal() | reactions.CancelGoal()
                | reactions.Log() | reactions.Diagnose() | reactions.Hook() | reactions.Reset()
            ):  # fmt: skip
                pass
    return found
