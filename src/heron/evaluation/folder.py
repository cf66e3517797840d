"""The files of an evaluation: the page, and a folder next to the page with the other files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit.campaign import Value
from dslkit.ownership import Comment, marked
from dslkit.writing import write_whole
from heron.evaluation.page import Results, page_of
from heron.evaluation.plots import plot_of, plot_of_study
from heron.evaluation.rows import read_rows, read_study, write_rows, write_study
from heron.evaluation.sample import samples_of
from heron.experiments import EXPERIMENTS, STUDIES

PAGE = "experiments.md"
_REST = "experiments"


@dataclass(frozen=True)
class Folder:
    """The folder of an evaluation. `path` is the path of the page."""

    path: Path

    @property
    def journal(self) -> Path:
        """The journal of the episodes that are done."""
        return self.path / _REST / "episodes.jsonl"

    def rows(self, name: str) -> Path:
        """The results of an experiment or a study."""
        return self.path / _REST / f"{name}.csv"

    def plot(self, name: str) -> Path:
        """The picture of an experiment or a study."""
        return self.path / _REST / f"{name}.svg"

    def results(self) -> Results:
        """The rows of all experiments and studies that have some."""
        return Results(
            {name: read_rows(path) for name in EXPERIMENTS if (path := self.rows(name)).exists()},
            {name: read_study(path) for name in STUDIES if (path := self.rows(name)).exists()},
        )


def write_page(folder: Folder, values: Mapping[str, Value]) -> Path:
    """Rows and plots of these results, and the page of all results in the folder."""
    for name, experiment in EXPERIMENTS.items():
        if rows := _chosen(values, experiment=name, study=None):
            write_rows(folder.rows(name), experiment, rows)
    for name, study in STUDIES.items():
        if rows := _chosen(values, study=name):
            write_study(folder.rows(name), study, [*rows, *_left(folder.rows(name), rows)])
    results = folder.results()
    for name, rows_of_experiment in results.experiments.items():
        samples = samples_of(EXPERIMENTS[name], rows_of_experiment)
        if samples:
            write_whole(folder.plot(name), plot_of(samples))
    for name, rows_of_study in results.studies.items():
        write_whole(folder.plot(name), plot_of_study(STUDIES[name], rows_of_study))
    page = folder.path / PAGE
    write_whole(page, marked(page_of(results, _REST), "heron", Comment.MARKUP))
    return page


def _left(path: Path, new: Sequence[Value]) -> list[Value]:
    """The rows of a study that are of other experiments than the new ones."""
    if not path.exists():
        return []
    names = {value["experiment"] for value in new}
    return [one.as_value() for one in read_study(path) if one.experiment not in names]


def _chosen(values: Mapping[str, Value], **wanted: str | None) -> list[Value]:
    return [
        value
        for value in values.values()
        if all(value.get(key) == each for key, each in wanted.items())
    ]
