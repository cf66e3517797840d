"""The resources that system models declare: names for groups of topics, services and so on that
command the same thing.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from rossmarie.check.actions.errors import SharedTarget, UnknownTarget
from rossmarie.check.actions.targets import TargetResolver
from rossmarie.check.actions.trees import SERVER
from rossmarie.check.scopes.declarations import report_second
from rossmarie.check.system.model import full_name
from rossmarie.syntax import ast
from rossmarie.types import InterfaceKind


def declared_resources(targets: TargetResolver) -> Mapping[str, str]:
    """The names of topics, services, action servers, nodes and controller managers that receive
    commands, each with its resource. Reports errors in the declarations.
    """
    found: dict[str, tuple[str, ast.Name]] = {}
    first: dict[str, ast.Name] = {}
    for resource in _declarations(targets):
        earlier = first.setdefault(resource.name.text, resource.name)
        if earlier is not resource.name:
            reason = "declare a resource once, with all its parts"
            report_second(resource.name, earlier, "resource", reason, targets.context.collector)
        for name in resource.targets:
            full = targets.full_name(InterfaceKind.MESSAGE, name)
            before = found.setdefault(full, (resource.name.text, name))
            if before[1] is not name:
                shared = SharedTarget(target=full, resource=before[0])
                label = shared.Other().at(before[1].span)
                targets.context.collector.add(shared.at(name.span, label))
    _report_unknown([name for _, name in found.values()], targets)
    return {target: resource for target, (resource, _) in found.items()}


def _declarations(targets: TargetResolver) -> Iterator[ast.ResourceDeclaration]:
    for system in targets.context.declarations.systems:
        for member in system.members:
            if isinstance(member, ast.ResourceDeclaration):
                yield member


def _report_unknown(names: Iterable[ast.Name], targets: TargetResolver) -> None:
    """Report names that occur nowhere else, because they are probably misspelt."""
    if not targets.is_parsed:
        return
    known = set(_known(targets))
    for name in names:
        if targets.full_name(InterfaceKind.MESSAGE, name) not in known:
            unknown = UnknownTarget(identifier=name.text)
            targets.context.report_unknown(unknown, name, sorted(known))


def _known(targets: TargetResolver) -> Iterator[str]:
    """The names that system models declare and effects use."""
    yield from targets.model.topics
    yield from (name for _, name in targets.stated)
    for item in targets.context.declarations.items:
        for effect in item.effects if isinstance(item, ast.Action) else ():
            yield from _named(effect, targets)


def _named(effect: ast.Effect, targets: TargetResolver) -> Iterator[str]:
    match effect:
        case ast.Limit(target=target) | ast.Scale(target=target) | ast.Block(target=target):
            yield targets.full_name(InterfaceKind.MESSAGE, target.name)
        case ast.Publish(target=target) | ast.Retrace(target=target):
            yield targets.full_name(InterfaceKind.MESSAGE, target.name)
        case ast.CallService(target=target) | ast.SendGoal(target=target):
            yield full_name(target.name.text)
        case ast.SetParameter(node=name):
            yield full_name(name.text)
        case ast.SwitchControllers(manager=name) | ast.CancelGoal(server=name):
            yield full_name(name.text)
        case ast.RunTree():
            yield SERVER
        case ast.Log() | ast.Diagnose() | ast.Hook() | ast.Reset():
            pass
