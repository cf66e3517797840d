"""The context of skills in SkiROS2's skill manager, for rules that monitor the robot.

It is published by a thread of the process of the skill manager: it ends when that dies, is stopped
or is started anew. As long as skills run, each of them has to give a sign of life; one that nobody
ticks, or whose end was missed, silences all. Where no skill runs it says so.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Mapping
from copy import deepcopy
from pathlib import Path
from typing import Any

from dslkit.diagnostics import Diagnostic
from dslkit.writing import reason
from ezskiros.context.ros import NoRosError, connect
from ezskiros.context.snapshot import Snapshots
from ezskiros.context.voice import Publish, Voice
from ezskiros.engine.running import RunningSkills
from ezskiros.export import changed_sources, not_exported, read_export
from ezskiros.export.write import PERIOD
from ezskiros.hosts.skiros2_api import api
from ezskiros.skills.interface import SkillInterface

Values = Callable[[], Mapping[str, Any]]


class HostedContext:
    """The skills of SkiROS2 that run, and the voice that tells of them."""

    def __init__(
        self, digest: str, publish: Publish, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self.digest, self._clock = digest, clock
        self.running = RunningSkills(self._tell)
        self._snapshots = Snapshots(digest)
        self._seen: dict[object, float] = {}
        """The last sign of life of each skill that runs."""
        self._reported = -math.inf
        self.voice = Voice(publish, clock=clock)
        self._tell()

    def start(self, owner: object, skill: SkillInterface, values: Values) -> None:
        """A skill starts."""
        self._seen[owner] = self._clock()
        self.running.start(owner, skill, self._clock(), values)

    def end(self, owner: object) -> None:
        """A skill has ended, if it runs at all."""
        self._seen.pop(owner, None)
        self.running.end(owner)

    def live(self, owner: object) -> None:
        """Note that a skill was ticked. Once per period, update the facts about its things."""
        if owner not in self._seen:
            return
        self._seen[owner] = now = self._clock()
        if now - self._reported >= PERIOD:
            self._tell()
        else:
            self.voice.live(self._alive())

    def keep(self) -> None:
        """The skills that run wait, as a tree runs in their place: that is no sign of death."""
        self._seen = dict.fromkeys(self._seen, self._clock())
        self.voice.live(self._alive())

    def _alive(self) -> float:
        """The time at which all that runs was alive; always if nothing runs."""
        return min(self._seen.values(), default=math.inf)

    def _tell(self) -> None:
        """Tell of what runs. What keeps that from being known silences the voice, and no skill."""
        self._reported = self._clock()
        try:
            # The processors of SkiROS2 do not say which of their children come next.
            snapshot = self._snapshots.of(self.running, None)
        except Exception as problem:
            api().log.error("ezskiros", f"the context is unknown: {problem!r}")
            self.voice.live(-math.inf)
        else:
            self.voice.tell(snapshot, self._alive())


_contexts: list[HostedContext] = []
"""The one of this process, if a library names an export."""
_refused: list[str] = []
"""The reasons why no context is or will be published."""


def current() -> HostedContext | None:
    """The context of this process; None if it is not reported."""
    return _contexts[0] if _contexts else None


def start(owner: object, skill: SkillInterface, values: Values) -> None:
    """A skill starts: nothing of it has moved yet."""
    for each in _contexts:
        each.start(owner, skill, values)


def end(owner: object) -> None:
    """A skill has ended, or could not start."""
    for each in _contexts:
        each.end(owner)


def live(owner: object) -> None:
    """A skill is ticked."""
    for each in _contexts:
        each.live(owner)


def watched(processor: Any, owner: object) -> Any:
    """A processor of SkiROS2 each of whose ticks is a sign of life of the compound above it."""
    return _Watched(processor, owner) if _contexts else processor


class _Watched:
    """Has the methods by which SkiROS2 knows a processor."""

    def __init__(self, processor: Any, owner: object) -> None:
        self._processor, self._owner = processor, owner

    def printType(self) -> str:  # noqa: N802 - as in SkiROS2
        """As SkiROS2 draws it."""
        found: str = self._processor.printType()
        return found

    def reset(self) -> None:
        """Before the first tick."""
        self._processor.reset()

    def processChildren(self, children: Any, visitor: Any) -> Any:  # noqa: N802
        """One tick, with a sign of life before and after it."""
        live(self._owner)
        found = self._processor.processChildren(children, visitor)
        live(self._owner)
        return found

    def __deepcopy__(self, memo: dict[int, Any]) -> Any:
        """Gives no sign of life: what is copied is simulated only."""
        return deepcopy(self._processor, memo)


# --- its beginning --------------------------------------------------------------------------------


def begin(
    path: Path,
    files: Iterable[Path],
    connecting: Callable[[], Publish] = connect,
) -> str | None:
    """Begin to tell the context, in the words of an export of these files; None if that is done,
    else why not. Then nothing is reported at all any more: rules take it for stale.
    """
    problem = _refused[0] if _refused else _begun(path, files, connecting)
    if problem is not None:
        _refused.append(problem)
        while _contexts:
            _contexts.pop().voice.end()
    return problem


def _begun(path: Path, files: Iterable[Path], connecting: Callable[[], Publish]) -> str | None:
    try:
        export = read_export(path)
    except OSError as problem:
        return f"cannot read {path}: {reason(problem)}"
    if isinstance(export, Diagnostic):
        return f"{export.primary.span}: {export.title}: {export.primary.text}"
    for found in (*changed_sources(export), *not_exported(export, files)):
        return f"{found.title}: {found.help}"
    if _contexts:
        is_same = _contexts[0].digest == export.digest
        return (
            None
            if is_same
            else f"{path} is the export of another library: export both libraries into one file"
        )
    try:
        context = HostedContext(export.digest, connecting())
    except NoRosError as problem:
        return str(problem)
    context.voice.begin()
    _contexts.append(context)
    return None
