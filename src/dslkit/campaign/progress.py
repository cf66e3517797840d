"""The progress bar of a campaign, and the failures above it."""

from __future__ import annotations

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from dslkit.campaign.workers import EpisodeResult


class Bar:
    """A progress bar, for use in a `with` statement."""

    def __init__(self, console: Console, title: str) -> None:
        self._progress = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeRemainingColumn(),
            console=console,
        )
        self._task = self._progress.add_task(title, total=None)

    def __enter__(self) -> Bar:
        self._progress.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._progress.stop()

    def begin(self, count: int, done: int) -> None:
        """Begin with `count` episodes, of which `done` were in the journal."""
        self._progress.update(self._task, total=count, completed=done)
        if done:
            self._progress.console.print(f"{done} of {count} are already done", highlight=False)

    def hear(self, result: EpisodeResult) -> None:
        """Count one more result."""
        if result.value is None:
            words = f"{result.key} failed: {result.failure}"
            self._progress.console.print(words, markup=False, highlight=False)
        self._progress.advance(self._task)
