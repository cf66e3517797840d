"""`rossmarie replay` and `rossmarie model`: what reads a recording."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

import typer

from dslkit.writing import replacing_text, write_whole
from rossmarie.cli.output import output
from rossmarie.cli.progress import reported_progress
from rossmarie.driver import RulesError
from rossmarie.driver.formatting import format_text
from rossmarie.driver.replay import replay_file
from rossmarie.engines import NATIVE
from rossmarie.ir import Category
from rossmarie.recordings import RecordingError, definition_path, open_recording, write_model
from rossmarie.report import Replay, render_timeline, verdict_lines, write_table

TIMELINE = "timeline.html"
VERDICTS = "verdicts.jsonl"


def run_replay(
    rules: Path,
    recording: Path,
    topic_map: Sequence[str],
    out: Path | None,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
    only: Sequence[Category],
) -> None:
    """Replay, print the findings and the table, and write the reports into `out`."""
    pairs = topic_pairs(topic_map)
    if out is not None:
        output.try_folder(out, TIMELINE, VERDICTS)
    with refusing(), reported_progress("replaying") as on_progress:
        replay, found = replay_file(
            rules,
            recording,
            topic_map=pairs,
            systems=systems,
            message_folders=message_folders,
            only=only,
            on_progress=on_progress,
        )
    output.print_findings(found)
    if replay.monitor != NATIVE:
        typer.echo(replay.notes[0], err=True)
    write_table(replay, sys.stdout)
    if out is not None:
        _save_reports(replay, out)


@contextmanager
def refusing() -> Iterator[None]:
    """End the run with the findings if rules, or a recording, cannot be used."""
    try:
        yield
    except RulesError as error:
        output.reject(error.diagnostics)
    except RecordingError as error:
        output.print_findings([error.diagnostic])
        raise typer.Exit(output.exit_code([error.diagnostic])) from None


def topic_pairs(topic_map: Sequence[str]) -> dict[str, str]:
    """The pairs that `--topic-map` states; the run ends if it contradicts itself."""
    pairs: dict[str, str] = {}
    for text in topic_map:
        wanted, recorded = _pair(text)
        if pairs.setdefault(wanted, recorded) != recorded:
            both = f"`{pairs[wanted]}` and `{recorded}`"
            output.fail(f"--topic-map leads from `{wanted}` to {both}; keep one", exit_code=2)
    return pairs


def _pair(text: str) -> tuple[str, str]:
    wanted, equals, recorded = text.partition("=")
    if not (wanted and equals and recorded):
        output.fail(f"--topic-map needs RULES=RECORDED, not `{text}`", exit_code=2)
    return wanted, recorded


def _save_reports(replay: Replay, out: Path) -> None:
    with output.writing_to(out):
        timeline, verdicts = write_reports(replay, out)
    typer.echo(f"wrote {timeline} and {verdicts}")


def write_reports(replay: Replay, out: Path) -> tuple[Path, Path]:
    """Write timeline and verdicts. Raises `OSError`."""
    timeline, verdicts = out / TIMELINE, out / VERDICTS
    out.mkdir(parents=True, exist_ok=True)
    write_whole(timeline, output.marked(render_timeline(replay)))
    with replacing_text(verdicts) as stream:
        stream.writelines(f"{line}\n" for line in verdict_lines(replay))
    return timeline, verdicts


def write_model_of(recording: Path, out: Path | None) -> None:
    """Print the system model of a recording, or write it to `out`, beside the definitions of types
    that no standard package has.

    The model has no mark: models are completed by hand, so it is the user's once it is written.
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
    """Write the .msg files of a model. One that is there may be completed by hand, so it stays."""
    for name, text in definitions.items():
        path = folder / definition_path(name)
        if path.is_file():
            typer.echo(f"kept {path}")
            continue
        with output.writing_to(path.parent):
            path.parent.mkdir(parents=True, exist_ok=True)
        output.save(path, text)
        typer.echo(f"wrote {path}")
