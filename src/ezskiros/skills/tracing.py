"""Execution of user methods with symbols for values that are unknown before the robot runs.

The module follows the patterns Early Dynamic Checking and Symbolic Tracing (thesis, Paper IV,
section 4.2): a method runs once per path through its branches. Side effects are refused, reported
and replaced, and endless code is stopped.
"""

from __future__ import annotations

import difflib
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import FunctionType
from typing import Generic, TypeVar

from dslkit.diagnostics import Diagnostic, DidYouMean, Remark, Template
from ezskiros import session
from ezskiros.ontology.symbols import UNKNOWN
from ezskiros.skills import errors
from ezskiros.skills.blame import said, user_files, user_place
from ezskiros.skills.description import PARTS
from ezskiros.skills.guard import CodeTimeOverError, SideEffectError, guarded
from ezskiros.skills.importing import forget_since, importing
from ezskiros.skills.intercept import intercept
from ezskiros.skills.syntax import definition, file_of
from ezskiros.skills.values import MOST_PATHS, Decisions, deciding

SECONDS = 5.0
"""The limit of processor time for one run of one method."""

T = TypeVar("T")


@dataclass(frozen=True)
class Method:
    """A method under check, and its class.

    `called` is its name in messages, and `advice` the help for its side effects. `undefined` makes
    the finding for an undefined name, with its help, and `substitute` the object that replaces the
    name.
    """

    owner: type
    function: FunctionType
    called: str
    advice: str
    undefined: Callable[[str], tuple[Template, Remark | None]]
    substitute: object = UNKNOWN


@dataclass(frozen=True)
class ExecutionPath(Generic[T]):
    """One path through a method: its inputs, None if they could not be made; whether it was
    completed; and whether it was free of errors until then.
    """

    instance: T | None
    decisions: Decisions
    has_ended: bool
    is_right: bool = True


def execution_paths(
    method: Method, make: Callable[[], T], run: Callable[[T, FunctionType], object]
) -> Iterator[ExecutionPath[T]]:
    """All paths through a method, within the limits. Mistakes are reported.

    For each path, `make` makes the object on which the method runs, and `run` runs it. An undefined
    name is reported and replaced, so that the code after it is checked, too.
    """
    planned: list[bool] | None = []
    substitutes: dict[str, object] = {}
    file, known = Path(file_of(method.owner)), dict(sys.modules)
    count = 0
    while planned is not None:
        names = len(substitutes)
        session.come_to(str(file))
        with importing(file), session.trying() as found:
            path, to_intercept = _execution_path(method, make, run, Decisions(planned), substitutes)
        if intercept(to_intercept):
            forget_since(known)
            continue
        for diagnostic in found.sorted():
            session.report(diagnostic)
        if len(substitutes) > names:
            continue
        yield replace(path, is_right=not found.sorted() and not substitutes)
        count += 1
        planned = path.decisions.following() if path.has_ended else None
        if planned is not None and count >= MOST_PATHS:
            cut = errors.TooManyPaths(method=method.called, count=MOST_PATHS)
            session.report(cut.at(definition(method.function).whole))
            return


def _execution_path(
    method: Method,
    make: Callable[[], T],
    run: Callable[[T, FunctionType], object],
    decisions: Decisions,
    substitutes: dict[str, object],
) -> tuple[ExecutionPath[T], Sequence[str]]:
    """One path, and the files whose interception would let it continue."""
    instance, problem = None, None
    with guarded(SECONDS) as guard, deciding(decisions):
        try:
            instance = make()
            run(instance, _with_names(method.function, substitutes))
        except KeyboardInterrupt:
            raise
        except BaseException as raised:
            problem = raised
    for refusal in guard.refusals():
        found = errors.SideEffect(method=method.called, deed=refusal.deed, advice=method.advice)
        session.report(found.at(refusal.span))
    if problem is not None and not isinstance(problem, SideEffectError):
        session.report(_raised(method, problem))
    missing = _missing_name(problem)
    if missing:
        substitutes[missing] = method.substitute
    to_intercept = [*guard.files, *([] if missing else user_files(problem))]
    return ExecutionPath(instance, decisions, problem is None), to_intercept


def _missing_name(problem: BaseException | None) -> str | None:
    """The undefined name behind an exception; None for other exceptions."""
    return problem.name if isinstance(problem, NameError) and type(problem) is NameError else None


def _with_names(function: FunctionType, names: Mapping[str, object]) -> FunctionType:
    """The function with additional names in its module."""
    if not names:
        return function
    more = {**function.__globals__, **names}
    found = FunctionType(
        function.__code__, more, function.__name__, function.__defaults__, function.__closure__
    )
    found.__kwdefaults__ = function.__kwdefaults__
    return found


def _raised(method: Method, problem: BaseException) -> Diagnostic:
    """The finding for an exception, at its last place in the user's code."""
    span = user_place(problem) or definition(method.function).whole
    if isinstance(problem, CodeTimeOverError):
        return errors.NeverEnds(method=method.called, seconds=SECONDS).at(span)
    if missing := _missing_name(problem):
        found, help = method.undefined(missing)
        return found.at(span, help=help)
    kind = type(problem).__name__
    found = errors.Raised(method=method.called, exception=kind, said=said(problem))
    return found.at(span, help=_help_for(problem))


def _help_for(problem: BaseException) -> Remark | None:
    """The help for a missing `self.`, as in `pre_conditions += ...`, or for a misspelt name."""
    if isinstance(problem, AttributeError) and problem.name:
        near = difflib.get_close_matches(problem.name, PARTS, n=1, cutoff=0.75)
        return DidYouMean(near=f"self.{near[0]}") if near else None
    unbound = isinstance(problem, UnboundLocalError)
    names = (each for each in PARTS if unbound and f"'{each}'" in str(problem))
    return next((errors.Raised.Added(conditions=each) for each in names), None)
