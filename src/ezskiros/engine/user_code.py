"""Calls of user methods. An error in such a method becomes the reason of a failure."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FunctionType
from typing import Any, NoReturn

from py_trees.common import Status

from ezskiros.engine.events import Code, Reason
from ezskiros.skills.blame import said, user_place
from ezskiros.skills.implementation import SkillImplementation, State
from ezskiros.skills.syntax import definition

STATUS = {
    State.SUCCESS: Status.SUCCESS,
    State.FAILURE: Status.FAILURE,
    State.RUNNING: Status.RUNNING,
}


class ProcessEndError(SystemExit):
    """A method tried to end the process of the run."""


@contextmanager
def kept_alive() -> Iterator[None]:
    """While the context is active, `os._exit` raises `ProcessEndError`: the run would end without a
    result, and perhaps with exit code 0. Forked processes can end themselves.
    """
    process, before = os.getpid(), os._exit

    def end(status: int) -> NoReturn:
        if os.getpid() == process:
            raise ProcessEndError(f"os._exit({status})")
        before(status)

    os._exit = end
    try:
        yield
    finally:
        os._exit = before


def execute(instance: SkillImplementation) -> Status | Reason:
    """Tick a primitive once."""
    try:
        found = instance.execute()  # type: ignore[attr-defined]
    except (Exception, SystemExit) as problem:
        return raised(problem, "execute", Code.EXECUTION)
    status = STATUS.get(found) if type(found) is State else None
    if status is not None:
        return status
    return _wrong(instance, "execute", found, "a result of self.success, self.step or self.fail")


def initialized(instance: SkillImplementation) -> Reason | None:
    """Call `onInit`. Returns None on success. As in SkiROS2, the method may return None."""
    try:
        found = instance.onInit()
    except (Exception, SystemExit) as problem:
        return raised(problem, "onInit", Code.START)
    return None if found is not False else _unwilling(instance, "onInit", Code.START)


def is_willing(instance: SkillImplementation, method: str, code: Code) -> Reason | None:
    """Call `onStart` or `onEnd`. Returns None on success."""
    called: Callable[[], Any] = getattr(instance, method)
    try:
        found = called()
    except (Exception, SystemExit) as problem:
        return raised(problem, method, code)
    if found:
        return None
    if found is None:
        return _wrong(instance, method, found, "True or False", code)
    return _unwilling(instance, method, code)


def _unwilling(instance: SkillImplementation, method: str, code: Code) -> Reason:
    """The reason after a method has reported a failure: the result of `self.fail`, if the method is
    the first that can report one.
    """
    reported, text = instance.progress
    if method != "onEnd" and reported < 0:
        return Reason(reported, str(text))
    return Reason(code, f"`{method}` reported a failure ({_place(instance, method)})")


def preempt(instance: SkillImplementation) -> Reason | None:
    """Call `onPreempt`, then `onEnd`. Returns None on success."""
    problem = None
    try:
        instance.onPreempt()
    except (Exception, SystemExit) as raising:
        problem = raised(raising, "onPreempt", Code.PREEMPTION)
    return is_willing(instance, "onEnd", Code.PREEMPTION) or problem


def raised(problem: BaseException, method: str, code: Code) -> Reason:
    """The reason after an exception of a method."""
    kind = type(problem).__name__
    span = user_place(problem)
    place = f" ({span})" if span else ""
    return Reason(code, f"`{method}` raised {kind}: {said(problem)}{place}")


def _wrong(
    instance: SkillImplementation,
    method: str,
    found: object,
    right: str,
    code: int = Code.EXECUTION,
) -> Reason:
    place = _place(instance, method)
    return Reason(code, f"`{method}` returned {_spelled(found)}, not {right} ({place})")


def _spelled(found: object) -> str:
    text = "nothing" if found is None else repr(found)
    return text if len(text) <= 40 else f"something of type {type(found).__name__}"


def _place(instance: SkillImplementation, method: str) -> str:
    """The file and line of a method."""
    function = getattr(type(instance), method, None)
    if not isinstance(function, FunctionType):
        return type(instance).__name__
    return str(definition(function).whole)
