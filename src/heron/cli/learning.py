"""`heron learn`: the campaign of trainings, a table with the progress of each arm, and the page."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from rich.console import Console
from rich.live import Live
from rich.table import Table

from dslkit.campaign import Campaign, EpisodeResult, Journal, Workers, run
from dslkit.command_line import CommandLine
from heron.cli.campaigns import carry_out
from heron.cli.choices import require_campaign
from heron.evaluation import sources
from heron.evaluation.learning import PAGE, LearningFolder, TrainingLogs, write_learning_page
from heron.learning.learned import learned
from heron.learning.runs import TrainingRun
from heron.learning.training import train

_FILMED = 3
"""The seed of an episode in which the person comes near."""


def learn(
    output: CommandLine, runs: Sequence[TrainingRun], out: Path, workers: Workers, film: Path | None
) -> None:
    """Run the trainings that are not in the journal, and write the page. On request, also write a
    film of the learned policies of all arms, from the first seed.
    """
    folder = LearningFolder(out)
    require_campaign(out, PAGE, folder.journal)
    carry_out(
        output, out, lambda: _campaign(runs, folder, workers), partial(write_learning_page, folder)
    )
    if film is not None:
        _write_film(output, runs, folder, film)


def _write_film(
    output: CommandLine, runs: Sequence[TrainingRun], folder: LearningFolder, out: Path
) -> None:
    from heron.cli.filming import write_film
    from heron.films.insertion import film_of_insertion

    first = [one for one in runs if (one.seed, one.algorithm) == (0, runs[0].algorithm)]
    clips = []
    for one in first:
        try:
            act = learned(folder.trainings, one)
        except FileNotFoundError:
            output.fail(f"no film: {folder.trainings / one.folder} was removed", exit_code=2)
        except ValueError as error:
            output.fail(f"no film: {error}", exit_code=2)
        clips.append(film_of_insertion(act, one.arm, _FILMED, one.formulation))
    write_film(output, clips, out)


def _campaign(runs: Sequence[TrainingRun], folder: LearningFolder, workers: Workers) -> Campaign:
    keys = [one.key for one in runs]
    work = partial(train, folder.trainings)
    with Journal(folder.journal, sources()) as journal:
        watch = TrainingLogs(folder.trainings, runs, journal.values)
        with _Progress(watch) as progress:
            return run(keys, work, journal, workers, progress)


class _Progress:
    """A table for each algorithm, its arms side by side, which looks into the logs of trainings."""

    def __init__(self, watch: TrainingLogs) -> None:
        self._console = Console(stderr=True, highlight=False)
        self._watch = watch
        self._live = Live(
            get_renderable=self._watch_now, console=self._console, refresh_per_second=2
        )

    def __enter__(self) -> _Progress:
        self._live.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._live.stop()
        if not self._console.is_terminal:  # where Rich does not end the last line of a table
            self._console.line()

    def begin(self, count: int, done: int) -> None:
        """Hear that the journal has `done` of `count` trainings."""
        if done:
            self._console.print(f"{done} of {count} are done already")

    def hear(self, result: EpisodeResult) -> None:
        """One more is over."""
        if result.value is None:
            self._console.print(f"{result.key} failed: {result.failure}", markup=False)
        else:
            self._watch.note_end(result.key)

    def _watch_now(self) -> Table:
        table = Table.grid(padding=(0, 1))
        for title, arms, rows in self._watch.look():
            part = Table("", *arms, title=title, title_justify="left")
            for column in part.columns[1:]:
                column.justify = "right"
            for label, cells in rows:
                part.add_row(label, *cells)
            table.add_row(part)
        return table
