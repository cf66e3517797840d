"""Destination of findings about skills: a check collects findings and continues; otherwise the
first finding is raised as an exception.
"""

from __future__ import annotations

import os
import site
import sys
import sysconfig
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

from dslkit.diagnostics import Collector, Diagnostic
from dslkit.source import SourceFile, Span
from dslkit.source.branches import asked
from dslkit.source.call_site import call_site

_SOURCES = Path(__file__).parents[1]
OURS = tuple(f"{_SOURCES / name}{os.sep}" for name in ("ezskiros", "dslkit"))
_INSTALLED = ("stdlib", "platstdlib", "purelib", "platlib")
_SITES = ("site-packages", "dist-packages")
LIBRARIES = tuple(
    f"{folder}{os.sep}"
    for folder in {
        *map(sysconfig.get_path, _INSTALLED),
        *site.getsitepackages(),
        site.getusersitepackages(),
        *(path for path in sys.path if Path(path).name in _SITES),  # such as the paths of ROS
    }
)
"""The folders of the standard library and of installed packages."""
_checked: ContextVar[tuple[str, ...]] = ContextVar("checked", default=())
_collector: ContextVar[Collector | None] = ContextVar("collector", default=None)
_follower: ContextVar[Callable[[str], object] | None] = ContextVar("follower", default=None)
_is_command: ContextVar[bool] = ContextVar("is_command", default=False)
NOWHERE = Span(SourceFile("<no source>", ""), 0, 0)
COMMAND_LINE = Span(SourceFile("<command line>", ""), 0, 0)


class SkillError(TypeError):
    """A mistake in a skill, raised when no session collects findings; `diagnostic` contains all
    details.
    """

    def __init__(self, diagnostic: Diagnostic) -> None:
        self.diagnostic = diagnostic
        parts = [diagnostic.title, diagnostic.primary.text, diagnostic.help or ""]
        super().__init__(f"{diagnostic.primary.span}: {'; '.join(filter(None, parts))}")


@contextmanager
def collecting(collector: Collector) -> Iterator[Collector]:
    """While the context is active, findings go to `collector`."""
    token = _collector.set(collector)
    try:
        yield collector
    finally:
        _collector.reset(token)


@contextmanager
def trying() -> Iterator[Collector]:
    """While the context is active, findings are kept apart, because the code may run again."""
    with collecting(Collector()) as collector:
        yield collector


@contextmanager
def checking(beginnings: Iterable[str]) -> Iterator[None]:
    """While the context is active, files whose paths have these beginnings count as the user's,
    even if they are installed.
    """
    token = _checked.set(tuple({each for each in beginnings if each.startswith(LIBRARIES)}))
    try:
        yield
    finally:
        _checked.reset(token)


@contextmanager
def commanding(collector: Collector) -> Iterator[Collector]:
    """While the context is active, findings go to `collector`, and no user code is running."""
    token = _is_command.set(True)
    try:
        with collecting(collector):
            yield collector
    finally:
        _is_command.reset(token)


@contextmanager
def following(tell: Callable[[str], object]) -> Iterator[None]:
    """While the context is active, `tell` is called with each file that the check reaches."""
    token = _follower.set(tell)
    try:
        yield
    finally:
        _follower.reset(token)


def come_to(path: str) -> None:
    """Report that the check has reached a file."""
    tell = _follower.get()
    if tell is not None:
        tell(path)


def is_of_user(path: str) -> bool:
    """Say whether a file is the user's: not a part of EzSkiROS, of a library or of Python."""
    if path.startswith((*OURS, "<frozen")):
        return False
    return path.startswith(_checked.get()) or not path.startswith(LIBRARIES)


def report(diagnostic: Diagnostic) -> None:
    """Collect a finding. Raises `SkillError` with the finding if no session collects findings."""
    collector = _collector.get()
    if collector is None:
        raise SkillError(diagnostic)
    collector.add(diagnostic)


def has_reported(span: Span) -> bool:
    """Say whether a finding lies within a span."""
    collector = _collector.get()
    places = [found.primary.span for found in collector.sorted()] if collector else []
    return any(span.contains(place) for place in places)


def here() -> Span:
    """The expression in the user's code that led here, directly or through libraries; the command
    line, if an EzSkiROS command did.
    """
    if _is_command.get():
        return COMMAND_LINE
    span = call_site(*OURS, *LIBRARIES, but=_checked.get()) or call_site(*OURS)
    return asked(span) if span else NOWHERE


def directly_here() -> Span:
    """The expression that led here, in the user's code or in a library."""
    return call_site(*OURS) or NOWHERE
