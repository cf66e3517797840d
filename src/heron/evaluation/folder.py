"""Where an evaluation is kept: the page, and beside it a folder with the rest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from campaign import Value
from heron.evaluation.page import page_of
from heron.evaluation.plots import plot_of
from heron.evaluation.rows import Row, read_rows, write_rows
from heron.evaluation.sample import samples_of
from heron.experiments import EXPERIMENTS

PAGE = "experiments.md"
_REST = "experiments"


@dataclass(frozen=True)
class Folder:
    """`path` is that of the page."""

    path: Path

    @property
    def journal(self) -> Path:
        """What is done."""
        return self.path / _REST / "episodes.jsonl"

    def rows(self, name: str) -> Path:
        """The results of an experiment."""
        return self.path / _REST / f"{name}.csv"

    def plot(self, name: str) -> Path:
        """Its picture."""
        return self.path / _REST / f"{name}.svg"

    def results(self) -> dict[str, list[Row]]:
        """Of all experiments that have some."""
        return {
            name: read_rows(self.rows(name)) for name in EXPERIMENTS if self.rows(name).exists()
        }


def write_page(folder: Folder, values: Mapping[str, Value]) -> Path:
    """Rows and plots of the experiments that these results are of, and the page of all that are in
    the folder.
    """
    for name, experiment in EXPERIMENTS.items():
        rows = [value for value in values.values() if value["experiment"] == name]
        if rows:
            write_rows(folder.rows(name), experiment, rows)
    results = folder.results()
    for name, rows_of_experiment in results.items():
        samples = samples_of(EXPERIMENTS[name], rows_of_experiment)
        if samples:
            folder.plot(name).write_bytes(plot_of(samples))
    page = folder.path / PAGE
    page.write_text(page_of(results, _REST), encoding="utf-8")
    return page
