"""The place in user code that caused an exception, and the text of the exception."""

from __future__ import annotations

from collections.abc import Iterator
from types import TracebackType

from dslkit.source import Span
from dslkit.source.call_site import place_of
from ezskiros import session
from ezskiros.ontology.symbols import SYMBOL_IN_TEXT


def said(problem: BaseException) -> str:
    """The text of an exception, in one line."""
    if isinstance(problem, RecursionError):
        return "it calls itself endlessly"
    if isinstance(problem, KeyError) and problem.args:
        return f"there is no {problem.args[0]!r}"
    text = str(problem).replace(SYMBOL_IN_TEXT, "")
    return text.partition("\n")[0] or "no message"


def user_place(problem: BaseException) -> Span | None:
    """The last place in the user's code from which an exception came."""
    steps = list(user_steps(problem.__traceback__))
    if isinstance(problem, RecursionError):
        steps = steps[:-1] or steps  # with a recursion error, the last place is arbitrary
    return next(filter(None, map(place_of, reversed(steps))), None)


def user_steps(traceback: TracebackType | None) -> Iterator[TracebackType]:
    """The parts of a traceback that are in the user's code."""
    while traceback is not None:
        path = traceback.tb_frame.f_code.co_filename
        if session.is_of_user(path) and not path.startswith("<"):
            yield traceback
        traceback = traceback.tb_next


def user_files(problem: BaseException | None) -> list[str]:
    """The files of the user's code that an exception passed; none if it is not related to
    symbols.
    """
    if not isinstance(problem, Exception) or isinstance(problem, RecursionError):
        return []
    steps = user_steps(problem.__traceback__)
    return list(dict.fromkeys(each.tb_frame.f_code.co_filename for each in steps))
