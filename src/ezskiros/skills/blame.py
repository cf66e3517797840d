"""Which place of the user's code an exception is blamed on, and what it says."""

from __future__ import annotations

from types import TracebackType

from dslkit.source import Span
from dslkit.source.call_site import place_of
from ezskiros import session


def said(problem: BaseException) -> str:
    """What an exception says, in one line."""
    if isinstance(problem, RecursionError):
        return "it calls itself without end"
    if isinstance(problem, KeyError) and problem.args:
        return f"there is no {problem.args[0]!r}"
    return str(problem).partition("\n")[0] or "without a word"


def user_place(traceback: TracebackType | None) -> Span | None:
    """The last place of the user's code in a traceback."""
    found = None
    while traceback is not None:
        path = traceback.tb_frame.f_code.co_filename
        if not path.startswith((*session.OURS, *session.LIBRARIES, "<")):
            found = place_of(traceback) or found
        traceback = traceback.tb_next
    return found
