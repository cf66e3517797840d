"""`ezskiros run --context`: publishes the running skills for rules that monitor the robot."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from dslkit.diagnostics import Diagnostic
from dslkit.writing import reason
from ezskiros.cli.output import output

if TYPE_CHECKING:  # loaded only when needed
    from ezskiros.context.snapshot import Snapshot
    from ezskiros.context.voice import Publish, Voice
    from ezskiros.engine.interruption import InterruptibleTask
    from ezskiros.export import Export
    from ezskiros.runner import Ready


def export_for(path: Path, ready: Ready) -> Export:
    """The export of the running skills. The run ends if the file is not an export, is stale, or has
    other skills.
    """
    from ezskiros.export import changed_sources, not_exported, read_export

    try:
        export = read_export(path)
    except OSError as problem:
        output.fail(f"cannot read {path}: {reason(problem)}", exit_code=2)
    if isinstance(export, Diagnostic):
        _refuse([export])
    found = [*changed_sources(export)] or [*not_exported(export, ready.sources)]
    if found:
        _refuse(found)
    return export


def _refuse(found: Sequence[Diagnostic]) -> NoReturn:
    output.print_findings(found)
    output.fail("nothing was run, because rules could not know which skills run", exit_code=2)


class ContextPublisher:
    """Publisher of the skills of a task that run or can start next: to a `Voice`, and to listeners
    of each change.
    """

    def __init__(
        self, export: Export, task: InterruptibleTask, hear: Callable[[Snapshot], object]
    ) -> None:
        from ezskiros.context.snapshot import Snapshots

        execution = task.execution
        self._snapshots, self._task = Snapshots(export.digest), task
        self._hear = hear
        self._last: Snapshot | None = None
        self._voice: Voice | None = None
        self._publish = None if execution.simulate else _publish(execution.clock)

    @contextmanager
    def reported(self) -> Iterator[None]:
        """Publish the context while the block runs."""
        from ezskiros.context.voice import Voice

        with ExitStack() as stack:
            if self._publish is not None:
                self._voice = stack.enter_context(Voice(self._publish))
            self._task.execution.running.changed = self.tell
            self.tell()
            yield
        if self._voice is not None and self._voice.problem is not None:
            output.complain(f"the context is no longer published: {self._voice.problem!r}")

    def tell(self) -> None:
        """Publish the running skills. The ticking thread calls this."""
        snapshot = self._snapshots.of(self._task.execution.running, self._task.ahead)
        if self._voice is not None:
            self._voice.tell(snapshot)
        if snapshot != self._last:
            self._hear(snapshot)
            self._last = snapshot

    def wait(self, seconds: float) -> None:
        """Wait between two ticks."""
        import time

        if self._voice is None:
            time.sleep(seconds)
        else:
            self._voice.wait(seconds)


def _publish(clock: Callable[[], float]) -> Publish | None:
    """The function that publishes on ROS; None if ROS is missing, which is reported."""
    from ezskiros.context.ros import NoRosError, connect

    try:
        return connect(clock)
    except NoRosError as problem:
        output.complain(f"the context is not published: {problem}")
        return None
