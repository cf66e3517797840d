"""Execution of a method that adds conditions. The result is its conditions, permissions and uses.

The method runs with symbols in place of its parameters, once per path through its branches (the
pattern Symbolic Tracing; thesis, Paper IV, section 4.2). Conditions that depend on a value are
reported: SkiROS2 reads a skill before it knows any value.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import FunctionType
from typing import Any

from dslkit.diagnostics import Diagnostic
from dslkit.source import Span
from ezskiros import session
from ezskiros.ontology.symbols import UNKNOWN, OntologyClass, symbol
from ezskiros.skills import errors
from ezskiros.skills.added import Added
from ezskiros.skills.interface import Clause, Parameter
from ezskiros.skills.parameters import signature_of
from ezskiros.skills.permits import Permission
from ezskiros.skills.tracing import ExecutionPath, Method, execution_paths
from ezskiros.skills.uses import Use
from ezskiros.skills.values import SymbolicValue


@dataclass(frozen=True)
class Adding:
    """The `self` of a method that runs, with the attributes to which the method adds."""

    instance: Any
    pre: Added[Clause]
    hold: Added[Clause]
    post: Added[Clause]
    permits: Added[Permission]
    uses: Added[Use]


@dataclass(frozen=True)
class PathConditions:
    """The additions on one path through a method."""

    pre: tuple[Clause, ...] = ()
    hold: tuple[Clause, ...] = ()
    post: tuple[Clause, ...] = ()
    permits: tuple[Permission, ...] = ()
    uses: tuple[Use, ...] = ()

    def said(self) -> tuple[frozenset[object], ...]:
        """All additions, without their places."""
        conditions = (self.pre, self.hold, self.post)
        statements = [frozenset(each.statement for each in clauses) for clauses in conditions]
        return (*statements, frozenset(self.permits), frozenset(self.uses))


def explored(
    method: Method, make: Callable[[], Adding], parameters: Sequence[Parameter]
) -> tuple[PathConditions, bool]:
    """The conditions that a method adds to the object that `make` returns, and whether they are
    complete. Paths are followed until one has other conditions than the first.
    """

    def run(adding: Adding, function: FunctionType) -> None:
        placed, named = _arguments(method.function, _symbols(parameters))
        function(adding.instance, *placed, **named)

    found: list[PathConditions] = []
    are_whole = True
    for path in execution_paths(method, make, run):
        conditions, is_whole = _conditions(path)
        if not path.has_ended:
            return conditions, is_whole
        if found and conditions.said() != found[0].said():
            session.report(_depends(method.owner.__name__, *path.decisions.last_planned()))
            break
        found.append(conditions)
        are_whole = are_whole and is_whole
    return found[0], are_whole


def _conditions(path: ExecutionPath[Adding]) -> tuple[PathConditions, bool]:
    """The conditions that a run has added, and whether they are complete."""
    if path.instance is None:
        return PathConditions(), False
    adding = path.instance
    found = PathConditions(
        tuple(adding.pre),
        tuple(adding.hold),
        tuple(adding.post),
        tuple(adding.permits),
        tuple(adding.uses),
    )
    parts = (adding.pre, adding.hold, adding.post, adding.permits, adding.uses)
    return found, path.has_ended and all(each.are_whole for each in parts)


def _symbols(parameters: Sequence[Parameter]) -> dict[str, object]:
    """The symbols for the parameters."""
    return {
        each.name: symbol(each.type, each.name)
        if isinstance(each.type, OntologyClass)
        else SymbolicValue(each.name, each.type)
        for each in parameters
    }


def _depends(skill: str, span: Span, symbol: object) -> Diagnostic:
    """The finding for conditions that depend on the truth value of a symbol."""
    if isinstance(symbol, SymbolicValue):
        return errors.DependsOnValue(skill=skill, parameter=repr(symbol)).at(span)
    return errors.DependsOnOutcome(skill=skill, call=repr(symbol)).at(span)


def _arguments(
    method: FunctionType, known: Mapping[str, object]
) -> tuple[list[object], dict[str, object]]:
    """The symbols, by position and by name. An invalid parameter gets an object that supports all
    operations.
    """
    placed: list[Any] = []
    named: dict[str, object] = {}
    for each in list(signature_of(method).parameters.values())[1:]:
        if each.kind is inspect.Parameter.POSITIONAL_ONLY:
            placed.append(known.get(each.name, UNKNOWN))
        elif each.kind not in _PACKED:
            named[each.name] = known.get(each.name, UNKNOWN)
    return placed, named


_PACKED = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)
