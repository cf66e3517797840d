"""The progress of running trainings, from their logs."""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from heron.evaluation.learning.names import TITLES
from heron.learning.arms import ARM_NAMES
from heron.learning.episodes import TrainingEpisode, episodes_of
from heron.learning.runs import TrainingRun
from heron.learning.summary import lately
from heron.learning.training import LOG

Rows = Sequence[tuple[str, Sequence[str]]]


@dataclass
class _Log:
    """The part of a log that was read: counts, and the last episodes."""

    path: Path
    run: TrainingRun
    offset: int = 0
    steps: int = 0
    count: int = 0
    violating: int = 0
    broken: int = 0
    last: Sequence[TrainingEpisode] = ()
    has_ended: bool = False

    def read(self) -> None:
        """Read the new whole lines."""
        try:
            with self.path.open("rb") as file:
                file.seek(self.offset)
                text = file.read()
        except FileNotFoundError:
            return
        whole = text[: text.rfind(b"\n") + 1]
        lines = whole.decode(errors="replace").splitlines()
        try:
            new = episodes_of(lines[1:] if self.offset == 0 else lines)
        except ValueError:  # the training itself reports this
            new = []
        self.offset += len(whole)
        self.count += len(new)
        self.violating += sum(one.is_violating for one in new)
        self.broken += sum(one.broken for one in new)
        self.last = lately(self.run.formulation, [*self.last, *new])
        self.steps = self.last[-1].steps if self.last else 0


class TrainingLogs:
    """The logs of trainings."""

    def __init__(
        self, folder: Path, runs: Sequence[TrainingRun], over: Container[str] = ()
    ) -> None:
        """`over` are the keys of trainings that are over."""
        self._logs = {
            run.key: _Log(folder / run.folder / LOG, run, has_ended=run.key in over) for run in runs
        }

    def note_end(self, key: str) -> None:
        """Note that a training is over."""
        self._logs[key].has_ended = True

    def look(self) -> Iterator[tuple[str, Sequence[str], Rows]]:
        """A title, the names of arms, and rows of cells, for each algorithm."""
        for log in self._logs.values():
            log.read()
        kinds = {(log.run.formulation, log.run.algorithm): None for log in self._logs.values()}
        for formulation, algorithm in kinds:
            logs = [
                log
                for log in self._logs.values()
                if (log.run.formulation, log.run.algorithm) == (formulation, algorithm)
            ]
            arms = list(dict.fromkeys(log.run.arm for log in logs))
            columns = [_column([log for log in logs if log.run.arm is arm]) for arm in arms]
            rows = [
                (label, [column[place] for column in columns])
                for place, label in enumerate(_LABELS)
            ]
            title = f"{TITLES[formulation]}, {algorithm}"
            yield title, [ARM_NAMES[arm] for arm in arms], rows


_LABELS = (
    "trainings over",
    "steps",
    "episodes",
    "inserted, of the last episodes",
    "proposed outside the rules, of the steps",
    "episodes with a violation",
    "fragile parts broken",
)


def _column(logs: Sequence[_Log]) -> list[str]:
    last = [one for log in logs for one in log.last]
    length = sum(one.length for one in last)
    return [
        f"{sum(log.has_ended for log in logs)} of {len(logs)}",
        f"{sum(log.steps for log in logs):,}",
        f"{sum(log.count for log in logs):,}",
        f"{100 * sum(one.inserted for one in last) / len(last):.0f} %" if last else "",
        f"{100 * sum(one.proposed_outside for one in last) / length:.0f} %" if last else "",
        str(sum(log.violating for log in logs)),
        str(sum(log.broken for log in logs)),
    ]
