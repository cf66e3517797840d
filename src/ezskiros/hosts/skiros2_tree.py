"""A behavior tree in SkiROS2's terms, as plain data: the skills of its nodes, the blackboard keys
that their parameters share, and the given values.

A SkiROS2 task has one flat blackboard that all of its skills write to. Only parameters that the
tree connects share a key. All others get their own keys, so that a value for one child never
becomes a value of another one.
"""

from __future__ import annotations

import enum
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import count

from ezskiros.engine.values import wanted
from ezskiros.ontology.statements import Value
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.interface import ROBOT, Parameter, SkillInterface
from ezskiros.skills.markers import ParameterKind
from ezskiros.skills.nodes import Decorator, Node, Processor
from ezskiros.skills.own_conditions import has_own_conditions
from ezskiros.skills.values import Symbol
from ezskiros.trees.library import Library
from ezskiros.trees.names import found_out, shared_names


@dataclass(frozen=True)
class HostedCall:
    """A child that is a skill. `label` is the requested implementation; None if any may run.

    `keys` maps each key of the child to a blackboard key.
    """

    type: str
    module: str
    """The module with the description."""
    label: str | None
    known: tuple[str, ...]
    """The possible implementations. SkiROS2 chooses one that can start."""
    is_choice: bool
    """True if the implementations' own pre-conditions decide which one runs."""
    keys: Mapping[str, str]
    values: Mapping[str, Value]
    """The values by the keys of the child."""
    passed: frozenset[str]
    """Keys of the child whose values come from the blackboard, even if they have a default."""
    found_out: Mapping[str, str]
    """Keys of the child, with the blackboard keys that get their values after a success."""


@dataclass(frozen=True)
class HostedNode:
    """A processor, or a decorator with its limit, over children."""

    processor: str
    children: tuple[HostedNode | HostedCall, ...]
    limit: float | None = None


@dataclass(frozen=True)
class Scope:
    """The names of a compound skill on the blackboard.

    `number` distinguishes the running skill from all others. `outer` maps its own keys to other
    blackboard keys.
    """

    skill: SkillInterface
    number: int
    outer: Mapping[str, str] = field(default_factory=dict)
    _calls: Iterator[int] = field(default_factory=lambda: count(1))

    def shared(self, name: str) -> str:
        """The key of a name that children share with the compound or with each other."""
        parameter = self.skill.parameter(name)
        if parameter is None:
            return f"{name}@{self.number}"
        return self.outer.get(parameter.key, parameter.key)

    def robot(self) -> str:
        """The key of the robot that SkiROS2 adds to skills without one."""
        return self.outer.get(ROBOT, ROBOT)

    def call(self) -> str:
        """The ending of keys that only the next child has."""
        return f"@{self.number}.{next(self._calls)}"


def hosted(node: Node, scope: Scope, library: Library) -> HostedNode | HostedCall:
    """A node of a tree and all nodes below it."""
    match node:
        case SkillCall():
            return _call(node, scope, library)
        case Processor(flow=flow, children=children):
            return HostedNode(flow.value, tuple(hosted(each, scope, library) for each in children))
        case Decorator(decoration=decoration, child=child, limit=limit):
            assert not isinstance(limit, Symbol), "a tree that starts is built for values"
            return HostedNode(decoration.value, (hosted(child, scope, library),), limit)


def _call(call: SkillCall, scope: Scope, library: Library) -> HostedCall:
    skill = library.skill(call.skill)
    assert skill is not None, call  # a library with an empty description is refused
    known, end = library.implementations(call.skill), scope.call()
    keys = {each.key: each.key + end for each in skill.parameters}
    shared = {each.parameter.key: scope.shared(each.shared) for each in shared_names(call, skill)}
    keys |= shared
    keys.setdefault(ROBOT, scope.robot())
    return HostedCall(
        type=skill.name,
        module=call.skill.__module__,
        label=call.implementation,
        known=tuple(known),
        is_choice=call.implementation is None and any(map(has_own_conditions, known.values())),
        keys=keys,
        values={
            each.key: lowered(call.arguments[each.name], each)
            for each in skill.parameters
            if each.name in call.arguments and each.key not in shared
        },
        passed=frozenset(shared),
        found_out={
            each.parameter.key: scope.shared(each.shared)
            for each in found_out(call, skill, library.doing(call))
        },
    )


def lowered(value: object, parameter: Parameter) -> Value:
    """A value of a parameter as SkiROS2 keeps it: for an enumeration, the name of the member."""
    if isinstance(value, enum.Enum):
        return value.name
    if parameter.type is float and type(value) is int:
        return float(value)
    assert isinstance(value, (str, int, float, bool)), value
    return value


def raised(value: Value | None, parameter: Parameter) -> object:
    """A value from SkiROS2, converted to the type of the parameter.

    Raises `ValueError` for a text that is not a member of an enumeration, and for a missing value.
    """
    if value is None:
        if parameter.kind is ParameterKind.REQUIRED and not parameter.is_output:
            raise ValueError(f"`{parameter.name}`, {wanted(parameter)}, has no value")
        return None
    if not issubclass(parameter.type, enum.Enum):
        return value
    members = parameter.type.__members__
    if value not in members:
        raise ValueError(f"`{parameter.name}` is {value!r}, but should be {wanted(parameter)}")
    return members[str(value)]
