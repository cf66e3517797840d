"""Checks of the arguments of `self.timeout(...)` and similar calls."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterable
from functools import wraps
from inspect import Parameter, Signature, signature
from typing import Concatenate, ParamSpec, TypeVar

from ezskiros import session
from ezskiros.skills import tree_errors as errors
from ezskiros.skills.growing import made
from ezskiros.skills.nodes import Flow, Node, Processor

_Arguments = ParamSpec("_Arguments")
_Self = TypeVar("_Self")
_FLOWS = {each.value.lower(): each for each in Flow}

Maker = Callable[Concatenate[_Self, _Arguments], Node]


def maker(method: Maker[_Self, _Arguments]) -> Maker[_Self, _Arguments]:
    """Wrap a method that makes a node. It reports invalid arguments, and the tree continues with
    the children among the valid ones, so that mistakes in them are found as well.
    """

    @wraps(method)
    def checked(self: _Self, /, *arguments: _Arguments.args, **named: _Arguments.kwargs) -> Node:
        try:
            return method(self, *arguments, **named)
        except TypeError as problem:
            is_call = problem.__traceback__ is not None and problem.__traceback__.tb_next is None
            if not is_call:
                raise
        _report(method.__name__, signature(method), len(arguments), named)
        given = (*arguments, *named.values())
        children = tuple(each for each in given if isinstance(each, Node))
        flow = _FLOWS.get(method.__name__, Flow.SERIAL_STAR)
        return made(Processor(flow, children, session.here()), children)

    return checked


def _report(name: str, known: Signature, count: int, named: Iterable[str]) -> None:
    _, *parameters = known.parameters.values()
    found = errors.WrongMakerCall(
        maker=name, call=_written(name, parameters), problem=_problem(parameters, count, named)
    )
    session.report(found.at(session.here()))


def _written(name: str, parameters: Iterable[Parameter]) -> str:
    """The text of a call of the method, such as `self.timeout(child, seconds)`."""
    is_many = Parameter.VAR_POSITIONAL
    names = ("child, ..." if each.kind is is_many else each.name for each in parameters)
    return f"self.{name}({', '.join(names)})"


def _problem(parameters: Iterable[Parameter], count: int, named: Iterable[str]) -> str:
    """The first invalid argument."""
    names = [each.name for each in parameters if each.kind is Parameter.POSITIONAL_OR_KEYWORD]
    for each in named:
        if each in names[:count]:
            return f"gets `{each}` twice"
        if each not in names:
            near = difflib.get_close_matches(each, names, n=1)
            meant = f": did you mean `{near[0]}`?" if near else ""
            return f"has no argument `{each}`{meant}"
    if names and count > len(names):
        return f"gets {count} arguments but takes {len(names)}"
    missing = next(each for each in names[count:] if each not in set(named))
    return f"needs `{missing}`"
