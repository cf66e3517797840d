"""The records of a study: progress logs, study logs, judgements of the leader, questionnaires."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import Any

from dslkit.study import StudyLogError, read_log
from study_kit.faults import CONDITIONS, State
from study_kit.lifetimes import Lifetime, lifetimes
from study_kit.sessions import FINDINGS, PROGRESS, SessionError, read_progress

JUDGEMENTS = "judgements.csv"
QUESTIONNAIRE = "questionnaire.csv"
SUS = tuple(f"sus{number}" for number in range(1, 11))
OPINIONS = ("readability", "modifiability", "writability")
_VERDICTS = ("fixed", "found", "missed")


@dataclass(frozen=True)
class Outcome:
    """The end of one planted fault in one session.

    `seconds` run from the start of the session to the fix, or to its end if there was no fix.
    `to_judge` says that neither the wrong nor the right text is there and no judgement either.
    """

    fault: str
    is_found: bool
    is_fixed: bool
    seconds: float
    to_judge: bool


@dataclass(frozen=True)
class Attempt:
    """One participant in one condition."""

    participant: str
    task: str
    condition: str
    outcomes: Sequence[Outcome]
    findings: Sequence[Lifetime]


@dataclass(frozen=True)
class Answers:
    """One questionnaire; items and opinions go from 1 (strongly disagree) to 5."""

    participant: str
    condition: str
    sus: Sequence[int]
    opinions: Mapping[str, int] = field(default_factory=dict)

    @property
    def score(self) -> float:
        """The SUS score from 0 to 100 (Brooke 1996)."""
        odd, even = self.sus[0::2], self.sus[1::2]
        return 2.5 * (sum(each - 1 for each in odd) + sum(5 - each for each in even))


@dataclass(frozen=True)
class Study:
    """All records in a folder of sessions."""

    attempts: Sequence[Attempt]
    answers: Sequence[Answers]


def read_study(folder: Path) -> Study:
    """All records in a folder. Raises `SessionError` with the place of a wrong line."""
    judged = dict(_judgements(folder / JUDGEMENTS))
    logs = sorted(folder.glob(f"*/{PROGRESS}"))
    if not logs:
        raise SessionError(f"{folder} has no sessions: a session is a folder with {PROGRESS}")
    attempts = [_attempt(log, judged) for log in logs]
    return Study(attempts, list(_answers(folder / QUESTIONNAIRE)))


Judged = Mapping[tuple[str, str, str], tuple[str, float | None]]


def _attempt(log: Path, judged: Judged) -> Attempt:
    lines = read_progress(log)
    participant, condition = lines[0]["participant"], lines[0]["condition"]
    outcomes = [
        _outcome(fault, lines, judged.get((participant, condition, fault)))
        for fault in lines[0]["faults"]
    ]
    return Attempt(participant, lines[0]["task"], condition, outcomes, _findings(log.parent))


def _findings(folder: Path) -> Sequence[Lifetime]:
    path = folder / FINDINGS
    if not path.exists():
        return []
    try:
        return lifetimes(read_log(path))
    except StudyLogError as problem:
        raise SessionError(f"{path}:{problem.line}:1: {problem.reason}") from None


def _outcome(
    fault: str, lines: Sequence[Mapping[str, Any]], judgement: tuple[str, float | None] | None
) -> Outcome:
    start = datetime.fromisoformat(lines[0]["time"])
    times = [(datetime.fromisoformat(line["time"]) - start).total_seconds() for line in lines]
    states = [State(line["faults"][fault]) for line in lines]
    last = states[-1]
    verdict, seconds = judgement or ("", None)
    if not verdict:
        verdict = "fixed" if last is State.FIXED else "missed"
    is_fixed = verdict == "fixed"
    if seconds is None:
        seconds = times[_first_of_the_last(states)] if is_fixed else times[-1]
    return Outcome(
        fault,
        is_found=verdict != "missed",
        is_fixed=is_fixed,
        seconds=seconds,
        to_judge=last is State.CHANGED and judgement is None,
    )


def _first_of_the_last(states: Sequence[State]) -> int:
    """The index from which on the state stays as it is at the end."""
    at = len(states) - 1
    while at > 0 and states[at - 1] is states[-1]:
        at -= 1
    return at


def _judgements(path: Path) -> Iterator[tuple[tuple[str, str, str], tuple[str, float | None]]]:
    for number, row in _rows(path, ("participant", "condition", "fault", "verdict", "seconds")):
        if row["verdict"] not in _VERDICTS:
            raise SessionError(f"{path}:{number}:1: a verdict is one of {', '.join(_VERDICTS)}")
        try:
            seconds = float(row["seconds"]) if row["seconds"] else None
        except ValueError:
            raise SessionError(f"{path}:{number}:1: `seconds` is not a number") from None
        yield (row["participant"], row["condition"], row["fault"]), (row["verdict"], seconds)


def _answers(path: Path) -> Iterator[Answers]:
    for number, row in _rows(path, ("participant", "condition", *SUS)):
        if row["condition"] not in CONDITIONS:
            known = ", ".join(CONDITIONS)
            raise SessionError(f"{path}:{number}:1: a condition is one of {known}")
        items = [_choice(row, name, path, number) for name in SUS]
        given = [name for name in OPINIONS if row.get(name)]
        opinions = {name: _choice(row, name, path, number) for name in given}
        yield Answers(row["participant"], row["condition"], items, opinions)


def _choice(row: Mapping[str, str], name: str, path: Path, number: int) -> int:
    if row[name] not in ("1", "2", "3", "4", "5"):
        raise SessionError(f"{path}:{number}:1: `{name}` is {row[name]!r}, not one of 1 to 5")
    return int(row[name])


def _rows(path: Path, columns: Sequence[str]) -> Iterator[tuple[int, dict[str, str]]]:
    """The rows of a table and their lines; none if there is no such file."""
    if not path.exists():
        return
    with path.open(newline="", encoding="utf-8") as opened:
        table = csv.DictReader(opened, restval="")
        missing = [name for name in columns if name not in (table.fieldnames or ())]
        if missing:
            raise SessionError(f"{path}:1:1: there is no column {', '.join(missing)}")
        for row in table:
            yield table.line_num, row
