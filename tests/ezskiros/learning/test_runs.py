"""Runs: stamps bring traces and verdicts together."""

from __future__ import annotations

from pathlib import Path

from dslkit.diagnostics import Diagnostic
from ezskiros.learning.runs import read_runs
from support.learning import active, header, refill, write


def trace(folder: Path, name: str, start: float) -> Path:
    return write(folder / f"{name}.jsonl", refill(start, "here"))


def verdicts(folder: Path, name: str, start: float, end: float) -> Path:
    return write(folder / f"{name}.jsonl", [header(start, end), *active(start, end)])


def wrong(*files: Path) -> list[tuple[str, str]]:
    runs, found = read_runs(files)
    assert runs == []
    return [(each.code, each.title) for each in found]


def shown(path: Path) -> str:
    return f"`{path}`"


def test_files_are_joined_by_their_time_in_any_order(tmp_path: Path) -> None:
    files = [
        trace(tmp_path, "a", 20),
        verdicts(tmp_path, "b", 0, 12),
        trace(tmp_path, "c", 1),
        verdicts(tmp_path, "d", 19, 25),
    ]
    runs, found = read_runs(files)
    assert found == []
    names = [(Path(each.trace.file.path).stem, Path(each.verdicts.file.path).stem) for each in runs]
    assert sorted(names) == [("a", "d"), ("c", "b")]


def test_a_file_that_is_named_twice_is_one_file(tmp_path: Path) -> None:
    files = [trace(tmp_path, "a", 1), verdicts(tmp_path, "b", 0, 12)]
    runs, _ = read_runs([*files, *files])
    assert len(runs) == 1


def test_a_run_without_its_other_half_is_reported(tmp_path: Path) -> None:
    first, second = trace(tmp_path, "a", 1), trace(tmp_path, "b", 30)
    found, others = verdicts(tmp_path, "c", 0, 12), verdicts(tmp_path, "d", 60, 70)
    assert wrong(first, second, found, others) == [
        ("EZS867", f"no verdicts cover the time of {shown(second)}"),
        ("EZS867", f"no traces cover the time of {shown(others)}"),
    ]


def test_the_other_clock_is_guessed(tmp_path: Path) -> None:
    """The stamps of a simulation begin at 0."""
    lines = [header(0, 12)]
    lines[0] |= {"start_ns": 0, "end_ns": 12 * 10**9}
    _, found = read_runs([trace(tmp_path, "a", 1), write(tmp_path / "b.jsonl", lines)])
    assert isinstance(found[0], Diagnostic)
    shown = "covers 2023-11-14 22:13:21.000 to 2023-11-14 22:13:31.000"
    assert shown in found[0].primary.text
    assert found[0].notes[1] == (
        "the nearest verdicts cover 1970-01-01 00:00:00.000 to 1970-01-01 00:00:12.000: if they "
        "belong to this run, another clock stamped them"
    )


def test_a_run_alone_needs_no_others_to_be_reported(tmp_path: Path) -> None:
    path = trace(tmp_path, "a", 1)
    assert wrong(path) == [("EZS867", f"no verdicts cover the time of {shown(path)}")]


def test_two_of_one_time_are_reported(tmp_path: Path) -> None:
    """The one that reaches far is compared, not only the one right before."""
    long, inside = verdicts(tmp_path, "a", 0, 50), verdicts(tmp_path, "b", 5, 6)
    last = verdicts(tmp_path, "c", 40, 60)
    files = [long, inside, last, trace(tmp_path, "d", 1), trace(tmp_path, "e", 45)]
    assert wrong(*files) == [
        ("EZS868", f"{shown(long)} and {shown(inside)} are verdicts of the same time"),
        ("EZS868", f"{shown(long)} and {shown(last)} are verdicts of the same time"),
    ]


def test_many_lonely_runs_are_not_all_reported(tmp_path: Path) -> None:
    files = [trace(tmp_path, f"trace_{number}", 20 * number) for number in range(30)]
    assert len(wrong(*files)) == 10
