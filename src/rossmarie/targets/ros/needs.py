"""The requirements of particular effects: headers, packages, shared objects of tasks, other
nodes.
"""

from __future__ import annotations

from typing import NamedTuple

from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.naming import relayed_servers, unfiltered
from rossmarie.targets.c99.names import string
from rossmarie.targets.ros import names
from rossmarie.targets.ros.dialect import Dialect, RosInterface, RuntimePart

MIDDLEWARE = "host.middleware()"


def resolved(name: str) -> str:
    """The C++ of the full name that a name of the rules has in the namespace of the node."""
    return f"{MIDDLEWARE}.resolved({names.relative(name)})"


def parts(machine: ir.Machine, dialect: Dialect) -> list[RuntimePart]:
    """The parts that the effects of the tasks need."""
    used = {type(task.effect) for task in machine.reactions.tasks}
    found = [part for effect, part in dialect.parts.items() if effect in used]
    is_relayed = dialect.relay is not None and bool(relayed_servers(machine))
    return [*found, dialect.relay] if is_relayed and dialect.relay else found


class SharedObject(NamedTuple):
    """An object that the tasks of a target share: a variable, its class, and the arguments of its
    constructor.
    """

    name: str
    kind: str
    arguments: tuple[str, ...]


def shared_objects(machine: ir.Machine, dialect: Dialect) -> list[SharedObject]:
    """The shared objects, in the order of the tasks that first need them."""
    tasks = machine.reactions.tasks
    effects = {name: tasks[index].effect for index, name in names.shared(machine).items()}
    relays = relayed_servers(machine) if dialect.relay else {}
    found = []
    for name, effect in effects.items():
        kind, arguments = _shared_kind(effect, dialect, relays)
        found.append(SharedObject(name, kind, (MIDDLEWARE, *arguments)))
    return found


def _shared_kind(
    effect: reactions.Effect, dialect: Dialect, relays: dict[str, str]
) -> tuple[str, tuple[str, ...]]:
    match effect:
        case reactions.SetParameter(node=node, parameter=parameter):
            return "Shared<Parameter>", (resolved(node), string(parameter))
        case reactions.SwitchControllers(manager=manager):
            return "Shared<Controllers>", (resolved(manager),)
        case reactions.SendGoal(server=server) | reactions.CancelGoal(server=server):
            if server not in relays:
                return "Goals", (resolved(server),)
            action = dialect.cpp_type(relays[server], RosInterface.ACTION)
            return f"Relay<{action}>", (resolved(server), resolved(unfiltered(server)))
        case (
            reactions.Limit() | reactions.Scale() | reactions.Publish() | reactions.Retrace()
            | reactions.Call() | reactions.Log() | reactions.Diagnose() | reactions.Hook()
            | reactions.Reset()
        ):  # fmt: skip
            raise AssertionError(f"nothing is shared: {effect}")


class Other(NamedTuple):
    """A requirement on another node: a service, or a topic that shows its presence."""

    title: str
    name: str
    is_service: bool


def others(machine: ir.Machine, dialect: Dialect) -> list[Other]:
    """The requirements on other nodes, in the order of the tasks."""
    found: dict[str, Other] = {}
    for task in machine.reactions.tasks:
        offered = _offered(task.effect, dialect)
        if offered is not None:
            title = str(reactions.target_of(task.effect))
            found.setdefault(title, Other(title, *offered))
    return list(found.values())


def _offered(effect: reactions.Effect, dialect: Dialect) -> tuple[str, bool] | None:
    """The name of a service, or of a topic."""
    match effect:
        case reactions.Call(service=service):
            return service, True
        case reactions.SetParameter(node=node):
            return f"{node}/set_parameters", True
        case reactions.SwitchControllers(manager=manager):
            return f"{manager}/switch_controller", True
        case reactions.SendGoal(server=server) | reactions.CancelGoal(server=server):
            return f"{server}{dialect.status_topic}", False
        case (
            reactions.Limit() | reactions.Scale() | reactions.Publish() | reactions.Retrace()
            | reactions.Log() | reactions.Diagnose() | reactions.Hook() | reactions.Reset()
        ):  # fmt: skip
            return None
