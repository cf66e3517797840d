"""Rows of episodes as CSV: one file for each experiment, with six digits."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from campaign import Value
from heron.experiments import Experiment

_KEYS = ("variant", "arm", "seed")


@dataclass(frozen=True)
class Row:
    """An episode: numbers by the names of measures, without those that it has not."""

    variant: str
    arm: str
    seed: int
    numbers: dict[str, float]


def write_rows(path: Path, experiment: Experiment, values: Iterable[Value]) -> None:
    """The results of an experiment, in the order of the variants, the arms and the seeds."""
    names = [measure.name for measure in experiment.measures]
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([*_KEYS, *names])
        for value in values:
            writer.writerow(
                [*(value[key] for key in _KEYS), *(_text(value[name]) for name in names)]
            )


def read_rows(path: Path) -> list[Row]:
    """What was written."""
    with path.open(encoding="utf-8", newline="") as file:
        return [
            Row(
                line.pop("variant"),
                line.pop("arm"),
                int(line.pop("seed")),
                {name: float(text) for name, text in line.items() if text},
            )
            for line in csv.DictReader(file)
        ]


def _text(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else ""
