"""Behavior trees in the format of the export."""

from __future__ import annotations

import enum
from typing import Any

from ezskiros import session
from ezskiros.export import errors
from ezskiros.export.places import ExportPlaces
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.nodes import Decoration, Decorator, Node, Processor
from ezskiros.skills.values import Symbol, plain
from ezskiros.trees.library import Library
from ezskiros.trees.names import shared_names
from ezskiros.trees.tree import IndividualReference, Tree, ValueReference

MOST_LEVELS = 200
"""The most levels of a tree. JSON readers support this depth without care, but not ten times this
depth.
"""


def tree_of(tree: Tree, library: Library, places: ExportPlaces) -> dict[str, Any]:
    """One tree of a compound skill."""
    return {
        "implementation": tree.implementation,
        "place": places.of(tree.span),
        "children": [_node(tree.root, library, places, 1)],
    }


def _node(node: Node, library: Library, places: ExportPlaces, level: int) -> dict[str, Any]:
    place = places.of(node.span)
    match node:
        case SkillCall():
            name = node.skill.__name__
            return {"skill": name, "arguments": _arguments(node, library), "place": place}
        case Processor(flow=flow, children=children):
            control, below, limit = flow.value.lower(), children, {}
        case Decorator(decoration=decoration, child=child):
            control, below, limit = decoration.value.lower(), (child,), _limit(node)
    if level >= MOST_LEVELS:
        session.report(errors.DeepTree(most=MOST_LEVELS).at(node.span))
        below = ()
    found = [_node(each, library, places, level + 1) for each in below]
    return {"control": control, **limit, "children": found, "place": place}


_LIMITS = {Decoration.TIMEOUT: "seconds", Decoration.RETRY: "tries"}
"""The keys of the numbers of decorators."""


def _limit(node: Decorator) -> dict[str, float | str]:
    """The number of a decorator, or the name of its parameter; empty if it is computed from
    parameters.
    """
    key, limit = _LIMITS.get(node.decoration), plain(node.limit)
    if isinstance(node.limit, ValueReference):
        limit = node.limit.parameter.name
    return {key: limit} if key is not None and isinstance(limit, int | float | str) else {}


def _arguments(call: SkillCall, library: Library) -> dict[str, str | None]:
    """The values of the parameters. Names that are shared with the compound and its children stay
    names; literals are written as in Python; None stands for a value that is computed from
    parameters.
    """
    skill = library.skill(call.skill)
    if skill is None:
        return {}
    shared = {each.parameter.name: each.shared for each in shared_names(call, skill)}
    given = {name: spelled_value(value) for name, value in call.arguments.items()}
    known = {**given, **shared}
    return {each.name: known[each.name] for each in skill.parameters if each.name in known}


def spelled_value(value: object) -> str | None:
    """A value as Python source; None for a value that is computed at run time."""
    if isinstance(value, (IndividualReference, ValueReference)):
        return value.parameter.name
    value = plain(value)
    if isinstance(value, enum.Enum):
        return f"{type(value).__name__}.{value.name}"
    return None if isinstance(value, Symbol) else repr(value)
