"""The folder of the study: the page, and a folder next to the page with the other files."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from dslkit.campaign import Value
from dslkit.ownership import Comment, marked
from dslkit.writing import replacing_text, write_whole
from heron.evaluation.learning.curves import curves_of
from heron.evaluation.learning.page import name_of, page_of
from heron.evaluation.learning.trainings import trainings_of

PAGE = "learning.md"
_REST = "learning"
_WORDS = ("formulation", "algorithm", "arm")


@dataclass(frozen=True)
class LearningFolder:
    """The folder of the study. `path` is the path of the page."""

    path: Path

    @property
    def journal(self) -> Path:
        """The journal of the trainings that are done."""
        return self.path / _REST / "trainings.jsonl"

    @property
    def trainings(self) -> Path:
        """The folder of training results: their logs, and the learned policies."""
        return self.path / _REST / "trainings"

    @property
    def rows(self) -> Path:
        """The rows of all trainings."""
        return self.path / _REST / "trainings.csv"


def write_learning_page(folder: LearningFolder, values: Mapping[str, Value]) -> Path:
    """Rows and curves of these trainings, and the page of all trainings in the folder."""
    rows = list(_merged(read_rows(folder.rows), values.values()))
    _write_rows(folder.rows, rows)
    found = trainings_of(rows)
    for one in found:
        picture = folder.rows.parent / f"{name_of(one)}.svg"
        write_whole(picture, curves_of(one))
    page = folder.path / PAGE
    write_whole(page, marked(page_of(found, _REST), "heron", Comment.MARKUP))
    return page


def read_rows(path: Path) -> list[Value]:
    """The rows of a file; none if there is no file."""
    if not path.exists():
        return []
    with path.open(encoding="utf-8", newline="") as file:
        return [
            {
                name: text if name in _WORDS else (float(text) if text else None)
                for name, text in line.items()
            }
            for line in csv.DictReader(file)
        ]


def _write_rows(path: Path, rows: Iterable[Value]) -> None:
    rows = list(rows)
    with replacing_text(path) as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(rows[0])
        writer.writerows([_text(value) for value in row.values()] for row in rows)


def _merged(old: Iterable[Value], new: Iterable[Value]) -> Iterable[Value]:
    """New rows instead of old ones of the same training."""
    found = {_training(row): row for row in [*old, *new]}
    return [found[key] for key in sorted(found)]


def _training(row: Value) -> tuple[str, ...]:
    seed, budget = (f"{float(row[name] or 0):09.0f}" for name in ("seed", "budget"))
    return (
        *(str(row[name]) for name in ("formulation", "algorithm")),
        budget,
        seed,
        str(row["arm"]),
    )


def _text(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else "" if value is None else str(value)
