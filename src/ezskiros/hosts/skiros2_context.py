"""The context of skills in SkiROS2's skill manager, for rules that monitor the robot.

A thread of the skill manager's process publishes the context, so publishing ends if the process
dies, is stopped or restarts. Each running skill has to give heartbeats: a skill that is not ticked,
or whose end was missed, stops the publishing. If no skill runs, an empty context is published.
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
    """The running skills of SkiROS2, and the voice that publishes them."""

    def __init__(
        self, digest: str, publish: Publish, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self.digest, self._clock = digest, clock
        self.running = RunningSkills(self._tell)
        self._snapshots = Snapshots(digest)
        self._seen: dict[object, float] = {}
        """The last heartbeat of each running skill."""
        self._reported = -math.inf
        self.voice = Voice(publish, clock=clock)
        self._tell()

    def start(self, owner: object, skill: SkillInterface, values: Values) -> None:
        """Record the start of a skill."""
        self._seen[owner] = self._clock()
        self.running.start(owner, skill, self._clock(), values)

    def end(self, owner: object) -> None:
        """Record the end of a skill, if it runs at all."""
        self._seen.pop(owner, None)
        self.running.end(owner)

    def live(self, owner: object) -> None:
        """Record a tick of a skill. Once per period, update the facts about its individuals."""
        if owner not in self._seen:
            return
        self._seen[owner] = now = self._clock()
        if now - self._reported >= PERIOD:
            self._tell()
        else:
            self.voice.live(self._alive())

    def keep(self) -> None:
        """Keep the running skills alive while they wait, because a tree runs instead of them."""
        self._seen = dict.fromkeys(self._seen, self._clock())
        self.voice.live(self._alive())

    def _alive(self) -> float:
        """The latest time at which all running skills were alive; the current time if none runs."""
        return min(self._seen.values(), default=math.inf)

    def _tell(self) -> None:
        """Publish the running skills. If they cannot be determined, stop publishing, but no
        skill.
        """
        self._reported = self._clock()
        try:
            # The processors of SkiROS2 do not show which of their children come next.
            snapshot = self._snapshots.of(self.running, None)
        except Exception as problem:
            api().log.error("ezskiros", f"the context is unknown: {problem!r}")
            self.voice.live(-math.inf)
        else:
            self.voice.tell(snapshot, self._alive())


_contexts: list[HostedContext] = []
"""The context of this process, if a library names an export."""
_refused: list[str] = []
"""The reasons why no context is or will be published."""


def current() -> HostedContext | None:
    """The context of this process; None if it is not reported."""
    return _contexts[0] if _contexts else None


def start(owner: object, skill: SkillInterface, values: Values) -> None:
    """Record the start of a skill, before any motion."""
    for each in _contexts:
        each.start(owner, skill, values)


def end(owner: object) -> None:
    """Record that a skill has ended, or could not start."""
    for each in _contexts:
        each.end(owner)


def live(owner: object) -> None:
    """Record a tick of a skill."""
    for each in _contexts:
        each.live(owner)


def watched(processor: Any, owner: object) -> Any:
    """A SkiROS2 processor whose ticks are heartbeats of the compound above it."""
    return _Watched(processor, owner) if _contexts else processor


class _Watched:
    """Has the methods by which SkiROS2 recognizes a processor."""

    def __init__(self, processor: Any, owner: object) -> None:
        self._processor, self._owner = processor, owner

    def printType(self) -> str:  # noqa: N802 - as in SkiROS2
        """The symbol in SkiROS2's drawing."""
        found: str = self._processor.printType()
        return found

    def reset(self) -> None:
        """Reset the state before the first tick."""
        self._processor.reset()

    def processChildren(self, children: Any, visitor: Any) -> Any:  # noqa: N802
        """Tick the children once, with a heartbeat before and after it."""
        live(self._owner)
        found = self._processor.processChildren(children, visitor)
        live(self._owner)
        return found

    def __deepcopy__(self, memo: dict[int, Any]) -> Any:
        """Copy without heartbeats, because copies are only simulated."""
        return deepcopy(self._processor, memo)


# --- its beginning --------------------------------------------------------------------------------


def begin(
    path: Path,
    files: Iterable[Path],
    connecting: Callable[[], Publish] = connect,
) -> str | None:
    """Start to publish the context, defined by an export of these files. Returns None on success,
    otherwise the reason; then nothing is published, and rules treat the context as stale.
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
