"""Rows of episodes as CSV: one file per experiment and per study, with six digits."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit.campaign import Value
from dslkit.writing import replacing_text
from heron.experiments import Experiment, Measure, Study

_KEYS = ("variant", "arm", "seed")
_STUDY_KEYS = ("value", "experiment", *_KEYS)


@dataclass(frozen=True)
class EpisodeRow:
    """An episode: numbers by the names of measures, without missing measures."""

    variant: str
    arm: str
    seed: int
    numbers: dict[str, float]


@dataclass(frozen=True)
class StudyRow:
    """An episode of a study: of an experiment, with another value of a setting."""

    value: float
    experiment: str
    row: EpisodeRow

    def as_value(self) -> Value:
        """The row as it came from its episode."""
        row = self.row
        return {
            "value": f"{self.value:g}",
            "experiment": self.experiment,
            "variant": row.variant,
            "arm": row.arm,
            "seed": row.seed,
            **row.numbers,
        }


def measures_of(study: Study) -> tuple[Measure, ...]:
    """The measures that all experiments of a study have."""
    first, *others = {case.experiment: case.of for case in study.cases}.values()
    return tuple(one for one in first.measures if all(one in other.measures for other in others))


def write_rows(path: Path, experiment: Experiment, values: Iterable[Value]) -> None:
    """Write the results of an experiment, in the order in which they were run."""
    _write(path, _KEYS, experiment.measures, values)


def write_study(path: Path, study: Study, values: Iterable[Value]) -> None:
    """Write the results of a study, in the order in which they were run."""
    _write(path, _STUDY_KEYS, measures_of(study), values)


def read_rows(path: Path) -> list[EpisodeRow]:
    """The rows of an experiment in a file."""
    with path.open(encoding="utf-8", newline="") as file:
        return [_row(line) for line in csv.DictReader(file)]


def read_study(path: Path) -> list[StudyRow]:
    """The rows of a study in a file."""
    with path.open(encoding="utf-8", newline="") as file:
        return [
            StudyRow(float(line.pop("value")), line.pop("experiment"), _row(line))
            for line in csv.DictReader(file)
        ]


def _write(
    path: Path, keys: Sequence[str], measures: Sequence[Measure], values: Iterable[Value]
) -> None:
    names = [measure.name for measure in measures]
    with replacing_text(path) as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([*keys, *names])
        for value in values:
            writer.writerow(
                [*(value[key] for key in keys), *(_text(value.get(name)) for name in names)]
            )


def _row(line: dict[str, str]) -> EpisodeRow:
    return EpisodeRow(
        line.pop("variant"),
        line.pop("arm"),
        int(line.pop("seed")),
        {name: float(text) for name, text in line.items() if text},
    )


def _text(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else ""
