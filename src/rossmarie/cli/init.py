"""`rossmarie init`: a folder with first rules, from a recording."""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from pathlib import Path

import typer

from rossmarie.cli.output import output
from rossmarie.cli.replay import refusing
from rossmarie.driver.workspace import SYSTEM_MODEL
from rossmarie.recordings.opening import open_recording
from rossmarie.recordings.system_model import definition_path
from rossmarie.starter import Beginning, begin

RULES = "robot.ross"
SEEN = "seen"


def run_init(recording: Path, folder: Path) -> None:
    """Write a system model, definitions of messages, and rules into a folder."""
    if folder.resolve() == recording.resolve():
        output.fail(f"{folder} is the recording; choose another --out", exit_code=2)
    _refuse_overwriting([folder / SYSTEM_MODEL, folder / RULES])
    output.try_folder(folder)
    with refusing(), open_recording(recording) as opened:
        output.print_findings(opened.findings)
        beginning = begin(opened)
    texts = _texts(beginning)
    _refuse_overwriting([folder / name for name in texts])
    for name, text in texts.items():
        path = folder / name
        with output.writing_to(path.parent):
            path.parent.mkdir(parents=True, exist_ok=True)
        output.save(path, text)
    _tell(beginning, recording, folder)


def _refuse_overwriting(paths: list[Path]) -> None:
    present = [path for path in paths if path.exists() or path.is_symlink()]
    if present and not output.permission.is_given:
        output.refuse_present(present)


def _texts(beginning: Beginning) -> dict[Path, str]:
    """The files by their paths in the folder."""
    from rossmarie.driver.formatting import format_text

    definitions = {
        Path(definition_path(name)): text for name, text in beginning.definitions.items()
    }
    return {
        **definitions,
        Path(SYSTEM_MODEL): format_text(beginning.model),
        Path(RULES): beginning.rules,
    }


def _tell(beginning: Beginning, recording: Path, folder: Path) -> None:
    """Print the written files, and the next commands."""
    rules = folder / RULES
    if beginning.definitions:
        typer.echo(f"wrote {len(beginning.definitions)} definitions of messages into {folder}/msg")
    typer.echo(f"wrote {folder / SYSTEM_MODEL}: the topics and the frames of the recording")
    typer.echo(
        f"wrote {rules}: {_count(beginning.inputs, 'input')}, 1 rule, its tests, and"
        f" {_count(beginning.proposals, 'proposal')} as comments"
    )
    typer.echo("now try:")
    replay = ["replay", str(rules), str(recording), *_topic_map(beginning.topic_map)]
    for words in (
        ["check", str(rules)],
        ["test", str(rules)],
        [*replay, "--out", str(folder / SEEN)],
    ):
        typer.echo(f"  rossmarie {shlex.join(words)}")


def _topic_map(pairs: Mapping[str, str]) -> list[str]:
    return [word for pair in pairs.items() for word in ("--topic-map", "=".join(pair))]


def _count(number: int, what: str) -> str:
    return f"{number} {what}" if number == 1 else f"{number} {what}s"
