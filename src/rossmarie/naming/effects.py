"""Names of effects: in messages of the node, in its README, in comments and in reports."""

from __future__ import annotations

from rossmarie import ir
from rossmarie.ir import reactions


def effect_words(machine: ir.Machine, effect: reactions.Effect) -> str:
    """An effect in a few words: `limit /cmd_vel`, `publish /horn at 2 Hz`."""
    match effect:
        case reactions.Limit(topic=topic) | reactions.Scale(topic=topic):
            return _bound_words(machine.reactions.commands[topic], effect)
        case (
            reactions.Publish(topic=name, period_ns=period_ns)
            | reactions.Retrace(topic=name, period_ns=period_ns)
        ):
            verb = "publish" if isinstance(effect, reactions.Publish) else "retrace on"
            return f"{verb} {name}" + ("" if period_ns is None else f" at {1e9 / period_ns:g} Hz")
        case reactions.Call(service=service):
            return f"call {service}"
        case reactions.SetParameter(node=node, parameter=parameter, value=value):
            return f"set {node}.{parameter} to {_value_words(value)}"
        case reactions.SwitchControllers(manager=manager):
            return f"switch {manager}"
        case reactions.SendGoal(server=server):
            return f"send to {server}"
        case reactions.CancelGoal(server=server):
            return f"cancel {server}"
        case reactions.Log(text=text):
            return f"log {text}"
        case reactions.Diagnose(text=text):
            return f"diagnose {text}"
        case reactions.Hook(name=name):
            return f"hook {name}"
        case reactions.Reset():
            return "reset"


def effect_target(machine: ir.Machine, effect: reactions.Effect) -> str | None:
    """The name of the target of an effect: a topic, a service, a server, a parameter, ...; None if
    it has no named target.
    """
    match effect:
        case reactions.Limit(topic=topic) | reactions.Scale(topic=topic):
            return machine.reactions.commands[topic].topic
        case (
            reactions.Publish(topic=name)
            | reactions.Retrace(topic=name)
            | reactions.Call(service=name)
            | reactions.SwitchControllers(manager=name)
            | reactions.SendGoal(server=name)
            | reactions.CancelGoal(server=name)
            | reactions.Hook(name=name)
        ):
            return name
        case reactions.SetParameter(node=node, parameter=parameter):
            return f"{node}.{parameter}"
        case reactions.Log() | reactions.Diagnose() | reactions.Reset():
            return None


def _bound_words(command: reactions.CommandTopic, effect: reactions.Limit | reactions.Scale) -> str:
    if isinstance(effect, reactions.Scale):
        return f"scale {command.topic} by {100 * effect.factor:g} %"
    return f"{'block' if reactions.is_block(command, effect) else 'limit'} {command.topic}"


def _value_words(value: reactions.Scalar) -> str:
    """A value in the notation of rules."""
    if isinstance(value, bool):
        return str(value).lower()
    return f'"{value}"' if isinstance(value, str) else f"{value:g}"
