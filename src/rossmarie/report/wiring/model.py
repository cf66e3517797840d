"""The wiring of a machine as data: the commands through its node, its inputs, and its outputs.

The input is a machine that `ir.verify` has accepted. The renderers in this package draw the result
of `wiring_of`.
"""

from __future__ import annotations

import enum
from collections.abc import Iterator
from dataclasses import dataclass

from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.naming import effect_words, node_name, relayed_servers, unfiltered

PLANNER = "planner"
ROBOT = "robot"
"""The publisher of commands, and their receiver. The rules contain neither name."""


@dataclass(frozen=True)
class EffectUse:
    """An effect in words (`limit /cmd_vel`), its action, and the rules that use it."""

    effect: str
    action: str
    rules: tuple[str, ...]

    def __str__(self) -> str:
        return f"{self.effect}: {self.action}, for {', '.join(self.rules)}"


@dataclass(frozen=True)
class Subscription:
    """A topic to which the node subscribes. `timeout_ns` is the least timeout of its inputs in ns;
    None if no input has a timeout.
    """

    topic: str
    message_type: str
    timeout_ns: int | None
    rules: tuple[str, ...]


@dataclass(frozen=True)
class WiredCommand:
    """Commands arrive on `unfiltered`, and leave on `topic` within the bounds of the uses."""

    unfiltered: str
    topic: str
    message_type: str
    uses: tuple[EffectUse, ...]


class TargetKind(enum.Enum):
    """The kinds of resources on which the node acts."""

    TOPIC = "topic"
    SERVICE = "service"
    ACTION_SERVER = "action server"
    PARAMETER = "parameter"
    CONTROLLER_MANAGER = "controller manager"


@dataclass(frozen=True)
class Output:
    """A target outside the node on which rules act. `type` is the type of messages, requests or
    goals; None if there is none or if it is unknown.
    """

    kind: TargetKind
    name: str
    type: str | None
    uses: tuple[EffectUse, ...]


@dataclass(frozen=True)
class NodeWiring:
    """The whole wiring. `remark` explains a part that a reader might miss; None if no part is
    missing.
    """

    node: str
    commands: tuple[WiredCommand, ...]
    inputs: tuple[Subscription, ...]
    outputs: tuple[Output, ...]
    remark: str | None


def wiring_of(machine: ir.Machine) -> NodeWiring:
    """The wiring of the node that is built from a machine."""
    commands = range(len(machine.reactions.commands))
    return NodeWiring(
        node=node_name(machine),
        commands=tuple(_command(machine, index) for index in commands),
        inputs=tuple(_inputs(machine)),
        outputs=tuple(_outputs(machine)),
        remark=_remark(machine),
    )


def _remark(machine: ir.Machine) -> str | None:
    if not machine.rules:
        return "There are no rules, so nothing is read and nothing is done."
    if not machine.reactions.tasks:
        return "No action of these rules has a body: the rules are watched, and nothing is done."
    remarks = []
    if not machine.reactions.commands:
        remarks.append("No rule limits, scales or blocks a command: none passes through the node.")
    for server in relayed_servers(machine):
        entrance = unfiltered(server)
        remarks.append(f"In ROS 2 goals for {server} enter at {entrance}, to be sent again.")
    return " ".join(remarks) or None


def _command(machine: ir.Machine, index: int) -> WiredCommand:
    command = machine.reactions.commands[index]
    tasks = [
        task
        for task, found in enumerate(machine.reactions.tasks)
        if _filtered(found.effect) == index
    ]
    return WiredCommand(
        unfiltered=unfiltered(command.topic),
        topic=command.topic,
        message_type=command.message_type,
        uses=_uses(machine, tasks),
    )


def _filtered(effect: reactions.Effect) -> int | None:
    """The command topic of an effect."""
    match effect:
        case reactions.Limit(topic=topic) | reactions.Scale(topic=topic):
            return topic
        case reactions.Publish(command=command):
            return command
        case (
            reactions.Retrace() | reactions.Call() | reactions.SetParameter()
            | reactions.SwitchControllers() | reactions.SendGoal() | reactions.CancelGoal()
            | reactions.Log() | reactions.Diagnose() | reactions.Hook() | reactions.Reset()
        ):  # fmt: skip
            return None


# --- inputs ----------------------------------------------------------------------------------


def _inputs(machine: ir.Machine) -> Iterator[Subscription]:
    read = [
        {*rule.inputs, *_confirming(machine, index)} for index, rule in enumerate(machine.rules)
    ]
    for index, channel in enumerate(machine.channels):
        if ir.is_setting(channel):
            continue
        used = {place for place, each in enumerate(machine.inputs) if each.channel == index}
        timeouts = (machine.inputs[place].timeout_ns for place in used)
        yield Subscription(
            topic=channel.topic,
            message_type=channel.message_type,
            timeout_ns=min((each for each in timeouts if each is not None), default=None),
            rules=tuple(
                rule.name for rule, its in zip(machine.rules, read, strict=True) if used & its
            ),
        )


def _confirming(machine: ir.Machine, rule: int) -> Iterator[int]:
    """The inputs of the confirmations of a rule, and the inputs whose poses it retraces."""
    plans, rests_on = machine.reactions.plans, ir.supports(machine).propositions
    for task in plans[rule].tasks if plans else ():
        effect = machine.reactions.tasks[task].effect
        if isinstance(effect, reactions.CancelGoal) and effect.confirmation is not None:
            yield from rests_on[machine.watches[effect.confirmation]].inputs
        if isinstance(effect, reactions.Retrace):
            for reading in machine.reactions.memories[effect.memory].readings:
                yield from ir.supports(machine).signals[machine.readings[reading]].inputs


# --- outputs ---------------------------------------------------------------------------------


def _outputs(machine: ir.Machine) -> Iterator[Output]:
    """The outputs on which tasks act, by kind, and in the order of the file within each kind."""
    found: dict[tuple[TargetKind, str], list[int]] = {}
    types: dict[tuple[TargetKind, str], str | None] = {}
    for index, task in enumerate(machine.reactions.tasks):
        target = _target(task.effect)
        if target is not None:
            kind, name, its_type = target
            found.setdefault((kind, name), []).append(index)
            types[kind, name] = types.get((kind, name)) or its_type
    for kind in TargetKind:
        for (each, name), tasks in found.items():
            if each is kind:
                yield Output(kind, name, types[kind, name], _uses(machine, tasks))


def _target(effect: reactions.Effect) -> tuple[TargetKind, str, str | None] | None:
    """The target of an effect outside of the node: its kind, name and type."""
    match effect:
        case (
            reactions.Publish(topic=topic, message_type=message_type, command=None)
            | reactions.Retrace(topic=topic, message_type=message_type)
        ):
            return TargetKind.TOPIC, topic, message_type
        case reactions.Call(service=service, service_type=service_type):
            return TargetKind.SERVICE, service, service_type
        case reactions.SendGoal() | reactions.CancelGoal():
            return TargetKind.ACTION_SERVER, effect.server, effect.action_type
        case reactions.SetParameter(node=node, parameter=parameter):
            return TargetKind.PARAMETER, f"{node}.{parameter}", None
        case reactions.SwitchControllers(manager=manager):
            return TargetKind.CONTROLLER_MANAGER, manager, None
        case (
            reactions.Limit() | reactions.Scale() | reactions.Publish() | reactions.Log()
            | reactions.Diagnose() | reactions.Hook() | reactions.Reset()
        ):  # fmt: skip
            return None


def _uses(machine: ir.Machine, tasks: list[int]) -> tuple[EffectUse, ...]:
    """The uses of an output by these tasks. Equal uses by several rules are one use."""
    rules: dict[tuple[str, str], dict[str, None]] = {}
    plans = zip(machine.rules, machine.reactions.plans, strict=True)
    rule_of = {task: rule.name for rule, plan in plans for task in plan.tasks}
    for index in tasks:
        task = machine.reactions.tasks[index]
        action = machine.reactions.actions[task.action].name
        key = effect_words(machine, task.effect), action
        rules.setdefault(key, {})[rule_of[index]] = None
    return tuple(
        EffectUse(effect, action, tuple(having)) for (effect, action), having in rules.items()
    )
