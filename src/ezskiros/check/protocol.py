"""Check that the methods of implementations are called, and that they return the values that
SkiROS2 expects.

`execute` returns the result of `self.success`, `self.step` or `self.fail`; `onStart` and `onEnd`
return True on success. These methods call the other ones.
"""

from __future__ import annotations

import ast
import difflib
import inspect
from collections.abc import Iterator, Mapping
from types import FunctionType

from dslkit.diagnostics import Diagnostic, DidYouMean, Remark
from dslkit.source import Span
from dslkit.source.call_site import node_span
from ezskiros.check import tree_errors as errors
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.skills.methods import WrittenMethod, own_method, reported_state, written
from ezskiros.skills.own_conditions import METHOD
from ezskiros.skills.syntax import attributes_in, class_span, definition

STATE, TRUTH = "execute", ("onStart", "onEnd")
TASKS = ("expandBT", STATE)
METHODS = (*TASKS, "onInit", *TRUTH, "onPreempt", METHOD)
"""The methods of an implementation that a host calls."""
_OF_SKIROS2: Mapping[str, Remark] = {
    "createDescription": errors.NeverCalled.SkillBase(),
    "modifyDescription": errors.NeverCalled.OwnConditions(method=METHOD),
    "expand": errors.NeverCalled.Tree(),
}
"""The methods of SkiROS2's own classes, each with its replacement."""
_NO_STATE = (
    ast.Constant, ast.Compare, ast.JoinedStr, ast.List, ast.Tuple, ast.Dict, ast.Set, ast.Lambda,
)  # fmt: skip
_PROGRESS = ((str, "a text"), (int, "a whole number"))


def check_protocol(implementation: type[SkillImplementation]) -> Iterator[Diagnostic]:
    """Report wrong return values of the methods, in the order of the protocol."""
    if not any(own_method(implementation, name) for name in TASKS):
        yield _nothing_to_do(implementation)
    else:
        yield from _never_called(implementation)
    for name in (STATE, *TRUTH):
        method = own_method(implementation, name)
        found = written(method) if method else None
        if method is not None and (given := _given_at_once(method)):
            wrong = errors.NoState if name == STATE else errors.NoTruth
            problem = wrong(implementation=implementation.__name__, method=name, found=given)
            yield problem.at(definition(method).whole)
        elif found is not None:
            yield from _wrong_returns(implementation.__name__, name, found)


def _given_at_once(method: FunctionType) -> str | None:
    """Name the object that a call returns before the body of the method runs; None if the body runs
    at once.
    """
    if inspect.iscoroutinefunction(method):
        return "a coroutine, because it is `async`"
    if inspect.isgeneratorfunction(method) or inspect.isasyncgenfunction(method):
        return "a generator, because it has `yield`"
    return None


def _nothing_to_do(implementation: type[SkillImplementation]) -> Diagnostic:
    """The finding for an implementation without a method of the protocol, with the method that may
    be meant.
    """
    found = errors.NothingToDo(implementation=implementation.__name__)
    for name, method in vars(implementation).items():
        near = difflib.get_close_matches(name, TASKS, n=1, cutoff=0.7)
        if near and isinstance(method, FunctionType):
            is_old = name == "expand"
            help = found.Migrate() if is_old else DidYouMean(near=near[0])
            return found.at(definition(method).whole, help=help)
    return found.at(class_span(implementation))


def _never_called(implementation: type[SkillImplementation]) -> Iterator[Diagnostic]:
    """Report methods whose names resemble those of the protocol, or are names of SkiROS2, and that
    the class never uses.
    """
    spoken_of = attributes_in(implementation)
    lower = {each.lower(): each for each in METHODS}
    for name, method in vars(implementation).items():
        if not isinstance(method, FunctionType) or name in {*METHODS, *spoken_of}:
            continue
        near = difflib.get_close_matches(name.lower(), lower, n=1, cutoff=0.85)
        help = _OF_SKIROS2.get(name) or (DidYouMean(near=lower[near[0]]) if near else None)
        if help is not None:
            found = errors.NeverCalled(implementation=implementation.__name__, method=name)
            yield found.at(definition(method).whole, help=help)


def _wrong_returns(implementation: str, method: str, found: WrittenMethod) -> Iterator[Diagnostic]:
    wrong = errors.NoState if method == STATE else errors.NoTruth
    for each in found.returns():
        if each.value is None:
            problem = wrong(implementation=implementation, method=method, found="nothing")
            yield problem.at(node_span(found.file, each))
    for value in filter(None, found.returned()):
        if _is_wrong(method, value):
            spelled = _spelled(found, value)
            problem = wrong(implementation=implementation, method=method, found=spelled)
            yield problem.at(node_span(found.file, value))
        yield from _wrong_progress(found, value)
    if not found.ends_with_return():
        problem = wrong(implementation=implementation, method=method, found="nothing at its end")
        start = node_span(found.file, found.node).start + len("def ")
        yield problem.at(Span(found.file, start, start + len(found.node.name)))


def _wrong_progress(found: WrittenMethod, value: ast.expr) -> Iterator[Diagnostic]:
    """Report an argument in a call such as `self.success(5)` that is not a text, or not a number
    where a number is expected.
    """
    name = reported_state(value)
    arguments = value.args if isinstance(value, ast.Call) and name else []
    for argument, (wanted, called) in zip(arguments, _PROGRESS, strict=False):
        given = argument.value if isinstance(argument, ast.Constant) else None
        if given is not None and type(given) is not wanted:
            wrong = errors.WrongProgress(
                method=name or "", found=_spelled(found, argument), wanted=called
            )
            yield wrong.at(node_span(found.file, argument))


def _is_wrong(method: str, value: ast.expr) -> bool:
    if method == STATE:
        return isinstance(value, _NO_STATE)
    return isinstance(value, ast.Constant) and value.value is None


def _spelled(found: WrittenMethod, value: ast.expr) -> str:
    return f"`{node_span(found.file, value).text}`"
