"""Verdicts and traces of tests, in seconds after `START_NS`."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ezskiros.learning.learn import learn
from ezskiros.learning.lessons import Lessons
from ezskiros.learning.runs import read_runs
from support.markdown import blocks

START_NS = 1_700_000_000 * 10**9
RAMP, SHELF = "http://example.org/depot#Station-3", "http://example.org/depot#Station-4"
LOCATIONS = {RAMP, SHELF}
PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "learn-from-runs.md"


def stamp(seconds: float) -> int:
    return START_NS + round(seconds * 1e9)


def event(
    at: float, happened: str, path: str, values: Mapping[str, Any] | None = None, text: str = ""
) -> dict[str, Any]:
    """An event; `path` is such as `Refill/Drive`, of the names of skills."""
    parts = path.split("/")
    found = {
        "tick": 1,
        "time": at,
        "at_ns": stamp(at),
        "event": happened,
        "path": parts,
        "skill": parts[-1].partition("#")[0],
        "implementation": None,
        "code": 0,
        "text": text,
    }
    return found if values is None else {**found, "parameters": values}


def ran(
    start: float, end: float, path: str, values: Mapping[str, Any] | None = None
) -> list[dict[str, Any]]:
    """A skill that succeeds, with nothing inside."""
    return [event(start, "started", path, values or {}), event(end, "succeeded", path)]


def refill(start: float, station: str, seconds: float = 10.0) -> list[dict[str, Any]]:
    """A task with a drive that takes all of its time but the last second."""
    end = start + seconds
    return [
        event(start, "started", "Refill", {"Station": station}),
        *ran(start, end - 1.0, "Refill/Drive", {"Target": station, "Speed": 0.5}),
        *ran(end - 1.0, end, "Refill/Charge", {"Station": station}),
        event(end, "succeeded", "Refill"),
    ]


def header(start: float, end: float, rules: Sequence[str] = ("tilting",)) -> dict[str, Any]:
    return {
        "type": "header",
        "schema": 1,
        "start_ns": stamp(start),
        "end_ns": stamp(end),
        "rules": list(rules),
    }


def verdict(at: float, rule: str = "tilting", **others: Any) -> dict[str, Any]:
    """A rule that becomes active, unless others say so."""
    return {
        "type": "verdict",
        "rule": rule,
        "at_ns": stamp(at),
        "active": True,
        "change": "activated",
        "exempts": None,
        "cause": {"text": f"found at {at:g}"},
        **others,
    }


def cleared(at: float, rule: str = "tilting") -> dict[str, Any]:
    return verdict(at, rule, active=False, change="cleared")


def active(start: float, end: float, rule: str = "tilting") -> list[dict[str, Any]]:
    return [verdict(start, rule), cleared(end, rule)]


def write(path: Path, lines: Sequence[Mapping[str, Any]]) -> Path:
    path.write_text("".join(json.dumps(each) + "\n" for each in lines), encoding="utf-8")
    return path


def learnt(folder: Path, *runs: tuple[list[dict[str, Any]], list[dict[str, Any]]]) -> Lessons:
    """The lessons of runs, each of a trace and verdicts with their header."""
    files = []
    for number, (trace, verdicts) in enumerate(runs):
        files.append(write(folder / f"trace_{number}.jsonl", trace))
        files.append(write(folder / f"verdicts_{number}.jsonl", verdicts))
    found, wrong = read_runs(files)
    assert wrong == [], [each.title for each in wrong]
    return learn(found, LOCATIONS)


def put_depot(folder: Path) -> None:
    """The skills, the scene and the rule of the page that tells users how to learn."""
    for each in blocks(PAGE.read_text("utf-8")):
        if each.name:
            (folder / each.name).write_text(each.text, encoding="utf-8")
