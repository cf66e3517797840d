"""The start plan of a child, computed once for each child."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from ezskiros.engine.options import emptied, locked, with_options
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.skills.markers import ParameterKind
from ezskiros.skills.own_conditions import has_own_conditions
from ezskiros.skills.values import plain
from ezskiros.trees.library import Implementations, Library
from ezskiros.trees.names import Shared, found_out, shared_names

_BASIC = frozenset((str, float, bool))


class ChildStart(NamedTuple):
    """The start of a child.

    `fixed` are the values of its parameters from defaults or the call. `shared` has the parameters
    that share a name with siblings, with that name; `received` has only those with a value before
    the start. `found_out` has those that share their value only after the child has succeeded.
    `label` names the implementation, if one is given; a compound builds a tree.
    """

    skill: SkillInterface
    implementation: type[SkillImplementation] | None
    label: str
    is_compound: bool
    fixed: Mapping[str, Any]
    shared: tuple[tuple[str, str], ...]
    received: tuple[tuple[str, str], ...]
    found_out: tuple[tuple[str, str], ...]
    needed: tuple[Parameter, ...]
    inferred: tuple[Parameter, ...]
    individuals: tuple[Parameter, ...]
    outputs: tuple[Parameter, ...]
    emptied: tuple[str, ...]
    locked: tuple[str, ...]

    def started_with(self, shared: Mapping[str, Any]) -> dict[str, Any]:
        """The values of the parameters, from defaults, from the call, or shared with siblings; None
        for values that are unknown before the start.
        """
        values = dict(self.fixed)
        for own, name in self.received:
            found = shared.get(name)
            if found is not None:
                values[own] = found
        return values


@dataclass(frozen=True)
class _Known:
    """The facts that are common to all children with the same skill."""

    skill: SkillInterface
    implementations: Implementations
    refined: Mapping[type[SkillImplementation] | None, SkillInterface]
    """The skill with the additional pre-conditions of each implementation."""
    parameters: Mapping[str, Parameter]
    defaults: Mapping[str, object]
    shared: tuple[tuple[str, str], ...]
    """The shared parameters that a call does not set."""
    found_out: Mapping[type[SkillImplementation] | None, tuple[tuple[str, str], ...]]
    """The parameters that are shared after a success, by implementation."""
    as_they_are: frozenset[type]
    """The types whose values need no conversion. An integer may have to become a float."""
    needed: tuple[Parameter, ...]
    inferred: tuple[Parameter, ...]
    individuals: tuple[Parameter, ...]
    outputs: tuple[Parameter, ...]
    emptied: tuple[str, ...]
    locked: tuple[str, ...]


class ChildPlans:
    """The plans of all children."""

    def __init__(self, library: Library) -> None:
        self._library = library
        self._plans: dict[SkillCall, Sequence[ChildStart]] = {}
        self._known: dict[type, _Known] = {}

    def of(self, call: SkillCall) -> Sequence[ChildStart]:
        """The plans of a child, at least one: the first one that can start is used. There are
        several if the child names no implementation and the implementations have their own
        pre-conditions.

        Raises `LookupError` if the description has no content.
        """
        plans = self._plans.get(call)
        if plans is None:
            known = self._known.get(call.skill) or self._look_up(call)
            kinds = _implementations(call, known)
            plans = self._plans[call] = tuple(self._made(call, known, each) for each in kinds)
        return plans

    def _made(
        self, call: SkillCall, known: _Known, kind: type[SkillImplementation] | None
    ) -> ChildStart:
        given = call.arguments
        if known.as_they_are.issuperset(map(type, given.values())):  # the common case
            fixed = {**known.defaults, **given}
            shared = tuple(pair for pair in known.shared if pair[0] not in given)
        else:
            fixed, shared = _looked_at(call, known)
        return ChildStart(
            skill=known.refined.get(kind, known.skill),
            implementation=kind,
            label=kind.__name__ if kind else "",
            is_compound=hasattr(kind, "expandBT"),
            fixed=fixed,
            shared=shared,
            received=_received(shared, known.outputs),
            found_out=tuple(pair for pair in known.found_out.get(kind, ()) if pair[0] not in given),
            needed=known.needed,
            inferred=known.inferred,
            individuals=known.individuals,
            outputs=known.outputs,
            emptied=known.emptied,
            locked=known.locked,
        )

    def _look_up(self, call: SkillCall) -> _Known:
        skill = self._library.skill(call.skill)
        if skill is None:
            raise LookupError(f"`{call.skill.__name__}` describes no skill")
        implementations = self._library.implementations(call.skill)
        nothing_given = replace(call, arguments={})
        has_floats = any(each.type is float for each in skill.parameters)
        found = self._known[call.skill] = _Known(
            skill=with_options(skill),
            implementations=implementations,
            refined={
                each: with_options(refined)
                for each in implementations.values()
                if has_own_conditions(each) and (refined := self._library.as_done_by(each))
            },
            parameters={each.name: each for each in skill.parameters},
            defaults={each.name: each.default for each in skill.parameters},
            shared=_pairs(shared_names(nothing_given, skill)),
            found_out={
                each: _pairs(found_out(nothing_given, skill, [each]))
                for each in implementations.values()
            },
            as_they_are=_BASIC if has_floats else _BASIC | {int},
            needed=tuple(each for each in skill.parameters if _is_needed(each)),
            inferred=tuple(
                each for each in skill.parameters if each.kind is ParameterKind.INFERRED
            ),
            individuals=tuple(each for each in skill.parameters if each.is_individual),
            outputs=tuple(each for each in skill.parameters if each.is_output),
            emptied=emptied(skill),
            locked=locked(skill),
        )
        return found


def _looked_at(
    call: SkillCall, known: _Known
) -> tuple[dict[str, object], tuple[tuple[str, str], ...]]:
    """The values of the parameters, and the names that they share with siblings."""
    fixed = dict(known.defaults)
    for name, value in call.arguments.items():
        fixed[name] = _converted(plain(value), known.parameters.get(name))
    shared = _pairs(shared_names(call, known.skill))
    for own, _ in shared:
        fixed[own] = known.defaults[own]
    return fixed, shared


def _pairs(those: Iterable[Shared]) -> tuple[tuple[str, str], ...]:
    return tuple((each.parameter.name, each.shared) for each in those)


def _implementations(call: SkillCall, known: _Known) -> list[type[SkillImplementation] | None]:
    """The requested implementation. Otherwise all implementations in the order in which they were
    loaded, up to the first one without its own pre-conditions.
    """
    if call.implementation is not None:
        return [known.implementations.get(call.implementation)]
    found: list[type[SkillImplementation] | None] = []
    for each in known.implementations.values():
        found.append(each)
        if each not in known.refined:
            return found
    return found or [None]


def _received(
    shared: tuple[tuple[str, str], ...], outputs: tuple[Parameter, ...]
) -> tuple[tuple[str, str], ...]:
    if not outputs:
        return shared
    names = {each.name for each in outputs}
    return tuple((own, other) for own, other in shared if own not in names)


def _is_needed(parameter: Parameter) -> bool:
    """Say whether a skill cannot start without a value for a parameter, and nothing can infer the
    value.
    """
    return parameter.kind is ParameterKind.REQUIRED and not parameter.is_output


def _converted(value: object, parameter: Parameter | None) -> object:
    """An integer for a float parameter, as a float; any other value unchanged."""
    is_float = parameter is not None and parameter.type is float
    return float(value) if is_float and type(value) is int else value
