"""Records from outside: each fault is reported with its line, and nothing else happens."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ezskiros.learning import records
from ezskiros.learning.runs import read_runs
from support.learning import START_NS, active, event, header, ran, refill, stamp, verdict, write

Lines = list[dict[str, Any]]


def said(path: Path) -> str:
    """The fault of a file: the line, what is marked there, and the reason."""
    runs, found = read_runs([path])
    assert runs == []
    (wrong,) = found
    assert wrong.code == "EZS866"
    span = wrong.primary.span
    marked = span.text if len(span.text) < 20 else "all"
    return f"{span.begin.line} {marked}: {wrong.title.partition('`: ')[2]}"


def changed(lines: Lines, line: int, change: Callable[[dict[str, Any]], object]) -> Lines:
    change(lines[line - 1])
    return lines


def verdicts() -> Lines:
    return [header(-1, 11), *active(2, 3), *active(4, 5)]


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (b"", "1 : it is empty"),
        (b"\n\n", "1 : it is empty"),
        (b"\x7fELF\x00\x01", "1 \x7f: this is not JSON (Expecting value)"),
        (b"caf\xe9", "1 : byte 4 is not UTF-8"),
        (b"[1, 2]\n", "1 [1, 2]: this is not a JSON object"),
        (b'{"event": ', "1  : this is not JSON (Expecting value)"),
        (b'{"at_ns": NaN}', '1 {"at_ns": NaN}: `NaN` is not a JSON number'),
        (b'{"a":' * 100_000, "1 all: its nesting is too deep"),
        (b'{"at_ns": ' + b"9" * 5000 + b"}", "1 all: Exceeds the limit"),
        (
            b'{"skills": []}',
            '1 {"skills": []}: its first line is neither the header of verdicts nor',
        ),
    ],
)
def test_what_is_no_record_is_reported(content: bytes, expected: str, tmp_path: Path) -> None:
    path = tmp_path / "records.jsonl"
    path.write_bytes(content)
    assert said(path).startswith(expected)


def test_a_file_that_is_too_large_is_not_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(records, "LARGEST_RECORD", 3 << 20)
    path = tmp_path / "records.jsonl"
    path.write_bytes(b" " * ((3 << 20) + 1))
    assert said(path) == "1 : it is larger than 3 MiB"


@pytest.mark.parametrize(
    ("line", "change", "expected"),
    [
        (
            1,
            lambda it: it.update(schema=2),
            '1 "schema": its `schema` is 2, but this EzSkiROS reads 1',
        ),
        (1, lambda it: it.pop("rules"), "1 all: `rules` is missing"),
        (1, lambda it: it.update(rules=[1]), '1 "rules": `rules` is not a list of strings'),
        (1, lambda it: it.update(end_ns=0), '1 "end_ns": it ends before it starts'),
        (
            1,
            lambda it: it.update(start_ns=-1),
            '1 "start_ns": `start_ns` is not a time stamp in nanoseconds',
        ),
        (1, lambda it: it.update(start_ns=1e18), '1 "start_ns": `start_ns` is not an integer'),
        (2, lambda it: it.update(rule="other"), '2 "rule": the header has no rule `other`'),
        (2, lambda it: it.update(active=1), '2 "active": `active` is not true or false'),
        (2, lambda it: it.update(cause=None), '2 "cause": `cause` is not an object'),
        (2, lambda it: it.update(type=7), '2 "type": `type` is not a text'),
        (
            3,
            lambda it: it.update(at_ns=stamp(1)),
            '3 "at_ns": this stamp is earlier than the one before, or outside the run',
        ),
        (
            4,
            lambda it: it.update(type="time_jump", from_ns=5, to_ns=3),
            '4 "from_ns": its time stamps jump back here',
        ),
    ],
)
def test_what_is_wrong_in_verdicts_is_reported(
    line: int, change: Callable[[dict[str, Any]], object], expected: str, tmp_path: Path
) -> None:
    path = write(tmp_path / "verdicts.jsonl", changed(verdicts(), line, change))
    assert said(path) == expected


@pytest.mark.parametrize(
    ("line", "change", "expected"),
    [
        (2, lambda it: it.pop("at_ns"), '2 "time": `at_ns` is missing'),
        (2, lambda it: it.update(at_ns=True), '2 "at_ns": `at_ns` is not an integer'),
        (
            2,
            lambda it: it.update(at_ns=2**63),
            '2 "at_ns": `at_ns` is not a time stamp in nanoseconds',
        ),
        (3, lambda it: it.update(at_ns=1), '3 "at_ns": this stamp is earlier than the one before'),
        (2, lambda it: it.update(path=[]), '2 "path": `path` names no skill'),
        (2, lambda it: it.update(path="Drive"), '2 "path": `path` is not a list'),
        (2, lambda it: it.update(skill=None), '2 "skill": `skill` is not a text'),
        (2, lambda it: it.update(parameters=[]), '2 "parameters": `parameters` is not an object'),
    ],
)
def test_what_is_wrong_in_a_trace_is_reported(
    line: int, change: Callable[[dict[str, Any]], object], expected: str, tmp_path: Path
) -> None:
    path = write(tmp_path / "trace.jsonl", changed(refill(0, "here"), line, change))
    assert said(path) == expected


def test_a_trace_that_breaks_off_is_refused(tmp_path: Path) -> None:
    path = write(tmp_path / "trace.jsonl", refill(0, "here")[:-2])
    assert said(path) == "4 all: it ends here while `Refill` runs"
    text = "".join(json.dumps(each) + "\n" for each in refill(0, "here"))
    path.write_text(text[:-20], encoding="utf-8")
    assert said(path).startswith('6 ": this is not JSON')


def test_a_trace_without_skills_is_refused(tmp_path: Path) -> None:
    context = {"tick": 1, "at_ns": START_NS, "event": "context", "running": []}
    path = write(tmp_path / "trace.jsonl", [context])
    assert said(path) == "1 all: it contains no skill"


def test_what_is_not_known_is_passed_over(tmp_path: Path) -> None:
    """Members, events and types may be added to both files."""
    order = {"type": "task_command", "command": "start", "at_ns": "?"}
    new = {"type": "rehearsal"}
    found = [header(-1, 6), {**verdict(2), "later": 1}, order, new]
    trace = [*ran(0, 5, "Drive")[:1], event(1, "paused", "Drive"), *ran(0, 5, "Drive")[1:]]
    trace[0]["parameters"] = {"Speed": 1e300, "Name": None, "List": [{}]}
    files = [write(tmp_path / "a.jsonl", found), write(tmp_path / "b.jsonl", trace)]
    (run,), wrong = read_runs(files)
    assert (wrong, len(run.verdicts.activations), len(run.trace.executions)) == ([], 1, 1)
