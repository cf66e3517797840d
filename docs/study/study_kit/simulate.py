"""Simulated participants with known effects, to try the analysis before a study."""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta, timezone
from pathlib import Path

import numpy as np

from dslkit import study
from study_kit.faults import CONDITIONS, Condition, Fault, State, planted_in
from study_kit.records import OPINIONS, QUESTIONNAIRE, SUS
from study_kit.sessions import FINDINGS, FORMAT, PROGRESS, VERSION

SESSION_S = 1500.0
"""Length of a session in seconds."""
PERIOD_S = 60.0
"""Seconds between two checks of a participant."""
START = datetime(2030, 1, 7, 9, tzinfo=timezone.utc)


@dataclass(frozen=True)
class Effects:
    """The effects that a simulation puts in: mean times to a fix in s, and mean SUS scores.

    A fault that a check does not find takes as long in our languages as in the plain ones.
    """

    ours_s: float = 300.0
    plain_s: float = 1200.0
    ours_sus: float = 80.0
    plain_sus: float = 55.0


NONE = Effects(ours_s=900.0, plain_s=900.0, ours_sus=65.0, plain_sus=65.0)
"""No difference between our languages and the plain ones."""


def simulate(folder: Path, participants: int, seed: int, effects: Effects) -> None:
    """Write the records of a study in which each participant does one task in each kind."""
    chance = np.random.default_rng(seed)
    folder.mkdir(parents=True)
    answers: list[Sequence[object]] = []
    for number in range(participants):
        name = f"P{number + 1:02d}"
        for condition in _conditions(number):
            _session(folder / f"{name}-{condition.name}", name, condition, effects, chance)
            sus = effects.ours_sus if condition.is_ours else effects.plain_sus
            answers.append([name, condition.name, *_sus(sus, chance), *_opinions(sus, chance)])
    with (folder / QUESTIONNAIRE).open("w", newline="", encoding="utf-8") as opened:
        table = csv.writer(opened)
        table.writerow(["participant", "condition", *SUS, *OPINIONS])
        table.writerows(answers)


def _conditions(number: int) -> Sequence[Condition]:
    """The two conditions of a participant: one task in our language, the other in a plain one."""
    plain_rules = "python" if number % 4 == 1 else "cpp"
    names = ("rossmarie", "skiros2") if number % 2 == 0 else (plain_rules, "ezskiros")
    return [CONDITIONS[name] for name in names]


def _session(
    folder: Path,
    participant: str,
    condition: Condition,
    effects: Effects,
    chance: np.random.Generator,
) -> None:
    folder.mkdir()
    faults = planted_in(condition)
    fixes = {each.id: _time_to_fix(each, condition, effects, chance) for each in faults}
    moments = sorted({0.0, SESSION_S, *(each for each in fixes.values() if each < SESSION_S)})
    lines = [_progress(participant, condition, fixes, moment) for moment in moments]
    _write_lines(folder / PROGRESS, lines)
    if condition.is_ours:
        checks = np.arange(0.0, SESSION_S + 1, PERIOD_S)
        _write_lines(
            folder / FINDINGS, [_run(condition, faults, fixes, float(each)) for each in checks]
        )


def _time_to_fix(
    fault: Fault, condition: Condition, effects: Effects, chance: np.random.Generator
) -> float:
    helps = condition.is_ours and bool(fault.variants[condition.name].codes)
    return float(chance.exponential(effects.ours_s if helps else effects.plain_s))


def _progress(
    participant: str, condition: Condition, fixes: dict[str, float], moment: float
) -> dict[str, object]:
    event = "start" if moment == 0.0 else "end" if moment == SESSION_S else "change"
    return {
        "format": FORMAT,
        "version": VERSION,
        "time": _time(moment),
        "participant": participant,
        "task": condition.task,
        "condition": condition.name,
        "event": event,
        "sha256": "0" * 64,
        "faults": {
            name: (State.FIXED if fixed <= moment else State.KEPT).value
            for name, fixed in fixes.items()
        },
    }


def _run(
    condition: Condition, faults: Sequence[Fault], fixes: dict[str, float], moment: float
) -> dict[str, object]:
    """One run of a check, which finds what is not fixed yet."""
    file = f"work/{condition.file}"
    place = {"line": 1, "column": 1}
    findings = [
        {"code": code, "severity": "error", "file": file, "start": place, "end": place}
        for each in faults
        if fixes[each.id] > moment
        for code in each.variants[condition.name].codes
    ]
    return {
        "format": study.FORMAT,
        "version": study.VERSION,
        "time": _time(moment),
        "tool": condition.name,
        "command": "check",
        "release": "simulated",
        "files": [{"name": file, "sha256": "0" * 64}],
        "findings": findings,
    }


def _sus(mean: float, chance: np.random.Generator) -> Sequence[int]:
    """Ten items whose score is `mean` on average, apart from the ends of the scale."""
    points = np.clip(np.rint(chance.normal(mean / 25, 0.7, len(SUS))), 0, 4).astype(int)
    return [int(each) + 1 if at % 2 == 0 else 5 - int(each) for at, each in enumerate(points)]


def _opinions(mean: float, chance: np.random.Generator) -> Sequence[int]:
    points = np.clip(np.rint(chance.normal(mean / 25, 0.7, len(OPINIONS))), 0, 4)
    return [int(each) + 1 for each in points]


def _time(moment: float) -> str:
    return (START + timedelta(seconds=moment)).isoformat(timespec="milliseconds")


def _write_lines(path: Path, lines: Sequence[dict[str, object]]) -> None:
    path.write_text("".join(json.dumps(each) + "\n" for each in lines), encoding="utf-8")
