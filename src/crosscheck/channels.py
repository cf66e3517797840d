"""Topics and servers in rules, skills and system models: different types, and messages without a
reader (thesis, Paper IV, section 5).
"""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from crosscheck.errors import NobodyReads, TypesDiffer
from crosscheck.robot import Robot
from dslkit.diagnostics import Diagnostic
from dslkit.source import Span
from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.skills import UseKind
from rossmarie.syntax import ast


@dataclass(frozen=True)
class Mention:
    """A place in the rules with the type of a topic or server."""

    type: str
    span: Span


def find_types_that_differ(robot: Robot) -> Iterator[Diagnostic]:
    """An error for each topic or server of a skill whose type differs in the rules."""
    reported = dict(_reported_types(robot.machine))
    for skill in robot.skills.skills.values():
        for use in skill.uses:
            mention = reported.get((use.kind, use.name))
            if mention is not None and use.type is not None and mention.type != use.type:
                found = TypesDiffer(
                    resource=use.name, one=mention.type, other=use.type, skill=skill.name
                )
                label = TypesDiffer.InRules(one=mention.type).at(mention.span)
                yield found.at(robot.span_of(use.place), label)


def _reported_types(machine: ir.Machine) -> Iterator[tuple[tuple[UseKind, str], Mention]]:
    for used in machine.inputs:
        channel = machine.channels[used.channel]
        yield (UseKind.TOPIC, channel.source), Mention(channel.source_type, used.span)
    for command in machine.reactions.commands:
        yield (UseKind.TOPIC, command.topic), Mention(command.message_type, command.span)
    for task in machine.reactions.tasks:
        match task.effect:
            case reactions.Publish(topic=name, message_type=its_type):
                yield (UseKind.TOPIC, name), Mention(its_type, task.span)
            case (
                reactions.SendGoal(server=name, action_type=found)
                | reactions.CancelGoal(server=name, action_type=found)
            ) if found is not None:
                yield (UseKind.SERVER, name), Mention(found, task.span)
            case _:  # open: the other effects have no type of a topic or server
                pass


def find_unread(robot: Robot) -> Iterator[Diagnostic]:
    """A warning for each topic that rules or skills publish and that no node of the system models
    subscribes to. There is no warning if no system model has nodes.
    """
    readers = dict(_readers(robot))
    if not readers:
        return
    known = {*readers, *(each.source for each in robot.machine.channels)}
    reported: set[str] = set()
    for topic, span in _sent(robot):
        if topic not in known and topic not in reported:
            reported.add(topic)
            yield _unread(topic, span, readers)


def _readers(robot: Robot) -> Iterator[tuple[str, str]]:
    """Topics, each with the name of a node that subscribes to it."""
    systems = [
        item for module in robot.modules for item in module.items if isinstance(item, ast.System)
    ]
    members = [member for system in systems for member in system.members]
    aliases = {
        each.alias.text: each.topic.text
        for each in members
        if isinstance(each, ast.TopicDeclaration) and each.alias is not None
    }
    for node in members:
        if isinstance(node, ast.NodeDeclaration):
            for name in node.subscribes:
                topic = aliases.get(name.text, f"/{name.text.removeprefix('/')}")
                yield topic, node.name.text


def _sent(robot: Robot) -> Iterator[tuple[str, Span]]:
    for task in robot.machine.reactions.tasks:
        if isinstance(task.effect, reactions.Publish | reactions.Retrace):
            yield task.effect.topic, task.span
    for skill in robot.skills.skills.values():
        for use in skill.uses:
            if use.kind is UseKind.TOPIC:
                yield use.name, robot.span_of(use.place)


def _unread(topic: str, span: Span, readers: Mapping[str, str]) -> Diagnostic:
    near = difflib.get_close_matches(topic, readers, n=1)
    help = NobodyReads.Near(near=near[0], node=readers[near[0]]) if near else None
    return NobodyReads(topic=topic).at(span, help=help)
