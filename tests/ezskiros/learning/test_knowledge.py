"""Knowledge as a file: written as its schema says, read again as it was, and refused else."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from dslkit.diagnostics import Diagnostic
from ezskiros.learning import knowledge as module
from ezskiros.learning.knowledge import Knowledge, known, read_knowledge, text_of
from ezskiros.learning.learn import learn
from ezskiros.learning.runs import read_runs
from support.json_schema import faults
from support.learning import (
    LOCATIONS,
    RAMP,
    SHELF,
    active,
    event,
    header,
    ran,
    refill,
    verdict,
    write,
)

SCHEMA: dict[str, Any] = json.loads(
    Path(module.__file__).with_name("knowledge.schema.json").read_text("utf-8")
)


def rich(folder: Path) -> Knowledge:
    """Knowledge that has something of everything."""
    gap = [
        *ran(40, 42, "Drive", {"Target": RAMP}),
        event(44, "failed", "Drive", text='no "way"\nat all'),
    ]
    runs = [
        (refill(0, RAMP), [header(-1, 11), *active(2, 5)]),
        (refill(20, SHELF), [header(19, 31), verdict(22, change="activated_stale")]),
        (gap, [header(39, 45), *active(43, 43.5)]),
    ]
    files = []
    for number, (trace, verdicts) in enumerate(runs):
        files.append(write(folder / f"trace_{number}.jsonl", trace))
        files.append(write(folder / f"verdicts_{number}.jsonl", verdicts))
    found, wrong = read_runs(files)
    assert wrong == []
    lessons = learn(found, LOCATIONS)
    assert all((lessons.trips, lessons.failures, lessons.costs, lessons.stale))
    return known(lessons, found, folder)


def test_what_is_written_is_as_the_schema_says_and_is_read_again(tmp_path: Path) -> None:
    knowledge = rich(tmp_path)
    path = tmp_path / "knowledge.json"
    path.write_text(text_of(knowledge), encoding="utf-8")
    assert faults(json.loads(text_of(knowledge)), SCHEMA) == []
    assert read_knowledge(path) == knowledge


def test_the_records_are_named_from_the_folder_of_the_file(tmp_path: Path) -> None:
    names = [each.path for each in rich(tmp_path).sources]
    assert names == sorted(
        f"{kind}_{number}.jsonl" for kind in ("trace", "verdicts") for number in range(3)
    )


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (lambda it: it.update(format="other"), "2: its `format` is not `ezskiros/knowledge`"),
        (
            lambda it: it.update(version=2),
            "3: its `version` is not 1, the only version that this EzSkiROS reads",
        ),
        (lambda it: it.update(version=True), "3: `version` is not an integer"),
        (lambda it: it.update(digest="0" * 64), "4: its `digest` does not match its `sources`"),
        (lambda it: it["sources"].pop(), "4: its `digest` does not match its `sources`"),
        (lambda it: it.pop("costs"), "1: `costs` is missing"),
        (lambda it: it["costs"][1].update(lost_s=-1), "23: `lost_s` is not a duration in seconds"),
        (
            lambda it: it["costs"][1].update(lost_s=None),
            "23: `lost_s` is not a duration in seconds",
        ),
        (lambda it: it["costs"][1].update(executions=-1), "23: `executions` is less than 0"),
        (lambda it: it["costs"][1].update(places={"a": 1}), "23: `a` is not a text"),
        (lambda it: it["trips"][0].update(runs=9), "15: `runs` is more than `all_runs`"),
        (lambda it: it.update(trips=[1]), "14: `trips` is not a list of objects"),
        (lambda it: it["trips"][0].update(within={"a": "b"}), "15: `a` is not an integer"),
        (lambda it: it["sources"][0].update(sha256="?"), "7: `sha256` is not 64"),
    ],
)
def test_what_is_wrong_is_reported_with_its_line(
    change: Callable[[dict[str, Any]], object], expected: str, tmp_path: Path
) -> None:
    knowledge = rich(tmp_path)
    found = json.loads(text_of(knowledge))
    change(found)
    path = tmp_path / "knowledge.json"
    lists = {key for key, value in found.items() if isinstance(value, list)}
    parts = [
        f'  "{key}": '
        + (
            "[\n" + ",\n".join(f"    {json.dumps(each)}" for each in value) + "\n  ]"
            if key in lists
            else json.dumps(value)
        )
        for key, value in found.items()
    ]
    path.write_text("{\n" + ",\n".join(parts) + "\n}\n", encoding="utf-8")
    wrong = read_knowledge(path)
    assert isinstance(wrong, Diagnostic)
    assert f"{wrong.primary.span.begin.line}: {wrong.primary.text}".startswith(expected)


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (b"", "it is not JSON: Expecting value"),
        (b"[]", "its `format` is not `ezskiros/knowledge`"),
        (b"\xff", "byte 1 is not UTF-8"),
        (b"[" * 100_000, "it is nested too deeply"),
        (b'{"runs": NaN}', "`NaN` is not a JSON number"),
        (b'{"runs": ' + b"9" * 5000 + b"}", "Exceeds the limit"),
    ],
)
def test_hostile_files_are_refused(content: bytes, expected: str, tmp_path: Path) -> None:
    path = tmp_path / "knowledge.json"
    path.write_bytes(content)
    wrong = read_knowledge(path)
    assert isinstance(wrong, Diagnostic)
    assert wrong.code == "EZS869"
    assert wrong.primary.text.startswith(expected)
