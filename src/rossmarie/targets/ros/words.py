"""What effects are called in messages of the node, in the README and in comments."""

from __future__ import annotations

from rossmarie import ir
from rossmarie.ir import reactions


def effect_words(machine: ir.Machine, effect: reactions.Effect) -> str:
    """An effect in few words: `limit /cmd_vel`, `publish /horn at 2 Hz`."""
    commands = machine.reactions.commands
    match effect:
        case reactions.Limit(topic=topic, bounds=bounds):
            is_block = all(bound.low == 0 == bound.high for bound in bounds)
            is_whole = len(bounds) == len(commands[topic].fields)
            return f"{'block' if is_block and is_whole else 'limit'} {commands[topic].topic}"
        case reactions.Scale(topic=topic, factor=factor):
            return f"scale {commands[topic].topic} by {100 * factor:g} %"
        case reactions.Publish(topic=name, period_ns=None):
            return f"publish {name}"
        case reactions.Publish(topic=name, period_ns=int(period_ns)):
            return f"publish {name} at {1e9 / period_ns:g} Hz"
        case reactions.Call(service=service):
            return f"call {service}"
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
        case _:
            return _refused_words(effect)


def _refused_words(effect: reactions.Effect) -> str:
    """What this target does not do."""
    match effect:
        case reactions.SetParameter(node=node, parameter=parameter):
            return f"set {node}.{parameter}"
        case reactions.SwitchControllers(manager=manager):
            return f"switch {manager}"
        case reactions.SendGoal(server=server):
            return f"send to {server}"
        case _:
            raise AssertionError(effect)
