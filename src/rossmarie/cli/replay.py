"""`rossmarie replay` and `rossmarie model`: the commands that read a recording."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

import typer

from dslkit.diagnostics import Diagnostic
from dslkit.diagnostics.render_json import Json
from dslkit.options import ReportFormat
from dslkit.writing import replacing_text, write_whole
from rossmarie.cli.output import each_once, output
from rossmarie.cli.progress import reported_progress
from rossmarie.driver import RulesError
from rossmarie.driver.formatting import format_text
from rossmarie.driver.replay import replay_file
from rossmarie.engines import NATIVE
from rossmarie.ir import Category
from rossmarie.recordings.errors import RecordingError
from rossmarie.recordings.opening import open_recording
from rossmarie.recordings.system_model import definition_path, write_model
from rossmarie.report.jsonl import verdict_lines
from rossmarie.report.model import Replay
from rossmarie.report.rehearsal import summarize_tasks
from rossmarie.report.runs import runs_of
from rossmarie.report.spans import summarize
from rossmarie.report.table import write_table
from rossmarie.report.timeline import render_timeline

TIMELINE = "timeline.html"
VERDICTS = "verdicts.jsonl"
_RULES = ".ross"


def run_replay(
    rules: Path,
    recordings: Sequence[Path],
    compared: Path | None,
    topic_map: Sequence[str],
    out: Path | None,
    form: ReportFormat,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
    only: Sequence[Category],
) -> None:
    """Replay one recording, print the findings and the table, and write the reports into `out`.

    `compared` is another recording, or another version of the rules, for a second run.
    """
    with output.answering(form, "replay", files=2) as answer:
        pairs = topic_pairs(topic_map)
        if compared is not None:
            _try_to_compare(recordings, out)
        if out is not None:
            output.try_folder(out, TIMELINE, VERDICTS)
        runs, found = [], list[Diagnostic]()
        for rules_file, recording in _runs(rules, recordings[0], compared):
            with refusing(), reported_progress("replaying") as on_progress:
                replay, findings = replay_file(
                    rules_file,
                    recording,
                    topic_map=pairs,
                    systems=systems,
                    message_folders=message_folders,
                    only=only,
                    with_recorded=out is not None,
                    on_progress=on_progress,
                )
            runs.append(replay)
            found += findings
        output.print_findings(each_once(found))
        if runs[0].monitor != NATIVE:
            typer.echo(runs[0].notes[0], err=True)
        if not answer.is_printed:
            _write_tables(runs)
        written = () if out is None else _save_reports(runs, out)
        if answer.is_printed:
            answer.result = _result(runs, written)


def _try_to_compare(recordings: Sequence[Path], out: Path | None) -> None:
    """End the run if a comparison has no output folder, or more than one recording."""
    if out is None:
        output.fail("--compare draws into timeline.html: name its folder with --out", exit_code=2)
    if len(recordings) > 1:
        both = "--compare takes one recording and one other file"
        output.fail(f"{both}; you named {len(recordings)} recordings", exit_code=2)


def _runs(rules: Path, recording: Path, compared: Path | None) -> Sequence[tuple[Path, Path]]:
    """The rules and the recording of each run."""
    if compared is None:
        return [(rules, recording)]
    if compared.suffix == _RULES:
        return [(rules, recording), (compared, recording)]
    return [(rules, recording), (rules, compared)]


def _write_tables(runs: Sequence[Replay]) -> None:
    """Print the table of each run, with the names of the runs if there are two."""
    for run in runs_of(*runs):
        if run.label:
            typer.echo(f"{run.label}:")
        write_table(run.replay, sys.stdout)
        if run.label:
            typer.echo()


def _result(runs: Sequence[Replay], written: Sequence[Path]) -> Json:
    """The result for programs: one recording, and the second run if there is one."""
    first, *second = (
        {
            "recording": run.recording,
            "failure": None,
            **replay_result(run, () if number else written),
        }
        for number, run in enumerate(runs)
    )
    return {"recordings": [first], **({"compared": second[0]} if second else {})}


@contextmanager
def refusing() -> Iterator[None]:
    """End the run with the findings if rules or a recording cannot be used."""
    try:
        yield
    except RulesError as error:
        output.reject(error.diagnostics)
    except RecordingError as error:
        output.print_findings([error.diagnostic])
        raise typer.Exit(output.exit_code([error.diagnostic])) from None


def topic_pairs(topic_map: Sequence[str]) -> dict[str, str]:
    """The pairs that `--topic-map` states. Contradictory pairs end the run."""
    pairs: dict[str, str] = {}
    for text in topic_map:
        wanted, recorded = _pair(text)
        if pairs.setdefault(wanted, recorded) != recorded:
            both = f"`{pairs[wanted]}` and `{recorded}`"
            output.fail(f"--topic-map maps `{wanted}` to {both}; keep one", exit_code=2)
    return pairs


def _pair(text: str) -> tuple[str, str]:
    wanted, equals, recorded = text.partition("=")
    if not (wanted and equals and recorded):
        output.fail(f"--topic-map needs RULES=RECORDED, not `{text}`", exit_code=2)
    return wanted, recorded


def _save_reports(runs: Sequence[Replay], out: Path) -> Sequence[Path]:
    with output.writing_to(out):
        timeline, verdicts = write_reports(*runs, out=out)
    output.tell(f"wrote {timeline} and {verdicts}")
    return timeline, verdicts


def write_reports(
    replay: Replay, compared: Replay | None = None, *, out: Path
) -> tuple[Path, Path]:
    """Write the timeline, with `compared` as its second run, and the verdicts of `replay`.

    Raises `OSError`.
    """
    timeline, verdicts = out / TIMELINE, out / VERDICTS
    out.mkdir(parents=True, exist_ok=True)
    write_whole(timeline, output.marked(render_timeline(replay, compared)))
    with replacing_text(verdicts) as stream:
        stream.writelines(f"{line}\n" for line in verdict_lines(replay))
    return timeline, verdicts


def write_model_of(recording: Path, out: Path | None) -> None:
    """Print the system model of a recording, or write it to `out`, with the definitions of
    non-standard types beside it.

    The model has no mark of generated files. Users complete it by hand, so it belongs to the user.
    """
    if out is not None:
        output.try_file(out)
    with refusing(), open_recording(recording) as opened:
        output.print_findings(opened.findings)
        definitions = {} if out is None else opened.definitions()
        text = format_text(write_model(opened, None if out is None else definitions))
    if out is None:
        typer.echo(text, nl=False)
        return
    _save_definitions(out.parent, definitions)
    output.save(out, text)
    output.tell_written(out)


def _save_definitions(folder: Path, definitions: Mapping[str, str]) -> None:
    """Write the .msg files of a model. An existing file stays, because a user may have completed it
    by hand.
    """
    for name, text in definitions.items():
        path = folder / definition_path(name)
        if path.is_file():
            typer.echo(f"kept {path}")
            continue
        with output.writing_to(path.parent):
            path.parent.mkdir(parents=True, exist_ok=True)
        output.save(path, text)
        typer.echo(f"wrote {path}")


def replay_result(replay: Replay, written: Sequence[Path]) -> Mapping[str, Json]:
    """The results of rules over a recording, and the paths of the written reports. Times are
    nanoseconds.
    """
    return {
        "length_ns": replay.end_ns - replay.start_ns,
        "monitor": replay.monitor,
        "rules": [
            {
                "rule": each.rule,
                "activations": each.activations,
                "stale_activations": each.stale_activations,
                "total_ns": each.total_ns,
                "longest_ns": each.longest_ns,
                "first_ns": each.first_ns,
                "first_cause": each.first_cause,
                "active_at_end": each.active_at_end,
            }
            for each in summarize(replay)
        ],
        "tasks": [
            {
                "rule": each.rule,
                "action": each.action,
                "effect": each.effect,
                "starts": each.starts,
                "overruled": [{"rule": rule, "times": times} for rule, times in each.overruled],
            }
            for each in summarize_tasks(replay.machine, replay.rehearsed)
        ],
        "written": [str(path) for path in written],
    }
