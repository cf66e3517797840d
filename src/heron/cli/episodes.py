"""Episodes on the terminal: the messages of the guard, and the measures."""

from __future__ import annotations

from collections.abc import Iterator

from rich.console import Console
from rich.table import Table

from heron.experiments import EpisodeFacts, Experiment


def print_episode(experiment: Experiment, episode: EpisodeFacts) -> None:
    """One episode of an experiment."""
    console = Console(highlight=False)
    for at_s, words in episode.reported:
        console.print(f"{at_s:8.2f} s  {words}", soft_wrap=True, markup=False)
    title = f"{episode.arm.value}, {experiment.describe(episode)}, seed {episode.seed}"
    table = Table("measure", "value", title=title, title_justify="left")
    table.columns[1].justify = "right"
    for name, value in _rows(experiment, episode):
        table.add_row(name, value)
    console.print(table)


def _rows(experiment: Experiment, episode: EpisodeFacts) -> Iterator[tuple[str, str]]:
    yield "task", "completed" if episode.measures.is_completed else "not completed"
    yield "ended", episode.outcome.value
    for measure in experiment.measures[1:]:
        value = measure.of(episode.measures)
        if value is not None:
            yield measure.label, measure.text(value)
