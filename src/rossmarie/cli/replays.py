"""`rossmarie replay` over many recordings. Each is an episode of a campaign, in a process of its
own, so an unreadable recording does not stop the others.
"""

from __future__ import annotations

import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import typer
from rich.console import Console

from dslkit.answer import Answer
from dslkit.campaign import Campaign, EpisodeResult, Journal, Processes, Value, run
from dslkit.diagnostics import Diagnostic
from dslkit.diagnostics.render_json import Json
from dslkit.diagnostics.wire import Receiver, Sender
from dslkit.ending import INTERNAL_ERROR, INTERRUPTED
from dslkit.options import ReportFormat
from dslkit.writing import reason
from rossmarie.cli.output import output
from rossmarie.cli.replay import (
    TIMELINE,
    VERDICTS,
    refusing,
    replay_result,
    topic_pairs,
    write_reports,
)
from rossmarie.driver import compile_file
from rossmarie.driver.replay import replay_file
from rossmarie.engines import start_monitor
from rossmarie.ir import Category
from rossmarie.recordings.errors import RecordingError
from rossmarie.report.model import Replay
from rossmarie.report.spans import summarize
from rossmarie.report.table import write_table
from rossmarie.report.wording import format_length


@dataclass(frozen=True)
class Job:
    """The common part of all jobs. `warnings` is the number of warnings about the rules, which are
    already printed. `width` is the width of the terminal, if there is one. With `is_json`, the
    result is data for programs instead of text.
    """

    rules: Path
    topic_map: Mapping[str, str]
    systems: Sequence[Path]
    message_folders: Sequence[Path]
    only: Sequence[Category]
    folders: Mapping[str, Path]
    warnings: int
    width: int | None
    is_json: bool


def run_replays(
    rules: Path,
    recordings: Sequence[Path],
    topic_map: Sequence[str],
    out: Path | None,
    form: ReportFormat,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
    only: Sequence[Category],
) -> None:
    """Replay all recordings, and print their results in order. Reports go into folders of `out`
    with the names of the recordings.
    """
    with output.answering(form, "replay", files=1 + len(recordings)) as answer:
        pairs = topic_pairs(topic_map)
        keys = list(map(str, recordings))
        folders = {} if out is None else _folders(out, keys)
        for folder in folders.values():
            output.try_folder(folder, TIMELINE, VERDICTS)
        with refusing():
            compiled = compile_file(
                rules, systems=systems, message_folders=message_folders, only=only
            )
        output.print_findings(compiled.warnings)
        started = start_monitor(compiled.machine)  # built once, for all processes
        if started.reason:
            typer.echo(started.reason, err=True)
        console = Console()
        width = console.width if console.is_terminal else None
        warnings = len(compiled.warnings)
        job = Job(
            rules,
            pairs,
            systems,
            message_folders,
            only,
            folders,
            warnings,
            width,
            answer.is_printed,
        )
        found = _campaign(keys, job)
        if answer.is_printed:
            answer.result = {"recordings": [_result(key, found, answer) for key in keys]}
        else:
            _tell(keys, found)
        raise typer.Exit(_exit_code(found))


def _folders(out: Path, keys: Sequence[str]) -> dict[str, Path]:
    """A folder for each recording. Recordings with the same name in different places get
    numbers.
    """
    folders: dict[str, Path] = {}
    for key in keys:
        name, number = Path(key).resolve().name, 1
        folder = out / name
        while folder in folders.values():
            number += 1
            folder = out / f"{name}-{number}"
        folders[key] = folder
    return folders


class _Reported:
    """A line on standard error for each completed recording."""

    def __init__(self) -> None:
        self._count = self._done = 0

    def begin(self, count: int, done: int) -> None:
        """Begin a campaign of `count` recordings."""
        self._count, self._done = count, done

    def hear(self, result: EpisodeResult) -> None:
        """Print one more result."""
        self._done += 1
        words = result.failure if result.value is None else result.value["summary"]
        typer.echo(f"{self._done} of {self._count}: {result.key}: {words}", err=True)


def _campaign(keys: Sequence[str], job: Job) -> Campaign:
    workers = Processes(Processes.cores(), limit_s=None)
    reported = _Reported()
    try:
        with (
            TemporaryDirectory() as folder,
            Journal(Path(folder) / "journal.jsonl", "replays") as journal,
        ):
            return run(keys, partial(replay_one, job), journal, workers, reported)
    except KeyboardInterrupt:
        output.fail("interrupted", exit_code=INTERRUPTED)


def replay_one(job: Job, key: str) -> Value:
    """Replay a recording, and return the result to the process that prints."""
    try:
        replay, found = replay_file(
            job.rules,
            Path(key),
            topic_map=job.topic_map,
            systems=job.systems,
            message_folders=job.message_folders,
            only=job.only,
            with_recorded=key in job.folders,
        )
    except RecordingError as error:
        outcome = _outcome(job, None, [error.diagnostic], [], "cannot be used")
        return {**outcome, "exit_code": output.exit_code([error.diagnostic])}
    trouble, code = "", 0
    written: Sequence[Path] = ()
    if key in job.folders:
        trouble, written = _write(replay, job.folders[key])
        code = 2 if trouble else 0
    outcome = _outcome(job, replay, found[job.warnings :], written, trouble)
    activations = sum(summary.activations for summary in summarize(replay))
    length_ns = replay.end_ns - replay.start_ns
    summary = f"{format_length(length_ns)}, {_counted(activations, 'activation')}"
    counts: Value = {"length_ns": length_ns, "activations": activations}
    return {**outcome, "summary": summary, "exit_code": code, **counts}


def _outcome(
    job: Job,
    replay: Replay | None,
    found: Sequence[Diagnostic],
    written: Sequence[Path],
    trouble: str,
) -> Value:
    """The findings and the result of a recording: as text, or as JSON for `_result`."""
    if job.is_json:
        messages: list[object] = []
        sender = Sender(messages.append)
        for each in found:
            sender.send(each)
        result = {} if replay is None else replay_result(replay, written)
        data = {"failure": trouble or None, **result}
        return {"messages": json.dumps(messages), "data": json.dumps(data), "summary": trouble}
    text = io.StringIO()
    console = Console(
        file=text, width=job.width, force_terminal=job.width is not None, highlight=False
    )
    output.print_findings(found, console)
    if replay is not None:
        write_table(replay, text, width=job.width)
        text.write(f"{trouble}\n" if trouble else "")
        text.write(f"wrote {' and '.join(map(str, written))}\n" if written else "")
    return {"text": text.getvalue(), "summary": trouble}


def _write(replay: Replay, folder: Path) -> tuple[str, Sequence[Path]]:
    """Write the reports. Returns the reason if writing failed, and the paths."""
    try:
        return "", write_reports(replay, out=folder)
    except OSError as error:
        return f"cannot write to {folder}: {reason(error)}", []


def _result(key: str, found: Campaign, answer: Answer) -> Json:
    """The result of a recording. The findings go to `answer`."""
    value = found.values.get(key)
    if value is None:
        reasons = {failure.key: failure.reason for failure in found.failures}
        return {"recording": key, "failure": f"not finished: {reasons[key]}"}
    receiver = Receiver()
    received = map(receiver.receive, json.loads(str(value["messages"])))
    answer.add([each for each in received if each is not None])
    return {"recording": key, **json.loads(str(value["data"]))}


def _tell(keys: Sequence[str], found: Campaign) -> None:
    reasons = {failure.key: failure.reason for failure in found.failures}
    for key in keys:
        typer.echo(f"{key}:")
        value = found.values.get(key)
        if value is None:
            typer.echo(f"not finished: {reasons[key]}")
        else:
            typer.echo(str(value["text"]).rstrip())
        typer.echo()
    typer.echo(_totals(found, len(keys)))


def _totals(found: Campaign, count: int) -> str:
    """The summary line."""
    used = [value for value in found.values.values() if "length_ns" in value]
    length_ns = sum(int(value["length_ns"] or 0) for value in used)
    activations = sum(int(value["activations"] or 0) for value in used)
    words = f"{len(used)} of {_counted(count, 'recording')} replayed, {format_length(length_ns)}"
    return f"{words}: {_counted(activations, 'activation')}"


def _counted(count: int, what: str) -> str:
    return f"{count} {what}{'' if count == 1 else 's'}"


def _exit_code(found: Campaign) -> int:
    """The worst exit code. An aborted replay is a defect."""
    if found.failures:
        return INTERNAL_ERROR
    return max(int(value["exit_code"] or 0) for value in found.values.values())
