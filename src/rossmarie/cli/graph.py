"""`rossmarie graph`: the wiring of a rules file, printed or written."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import typer
from rich.console import Console

from dslkit.ownership import Comment
from rossmarie.cli.choices import GraphFormat
from rossmarie.cli.output import output
from rossmarie.driver import RulesError, compile_file
from rossmarie.report.wiring import Wiring, wiring_dot, wiring_of, wiring_svg, wiring_text

_RULES = ".ross"
_COMMENTS = {GraphFormat.DOT: Comment.SLASHES, GraphFormat.TEXT: Comment.HASH}


def run_graph(
    rules: Path,
    form: GraphFormat,
    out: Path | None,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
) -> None:
    """Print the wiring, or write it to `out`; a rules file is not written over."""
    if out is not None and out.suffix == _RULES:
        output.fail(f"{out} would be a rules file; choose another --out", exit_code=2)
    output.try_file(out)
    try:
        compiled = compile_file(rules, systems=systems, message_folders=message_folders)
    except RulesError as error:
        output.reject(error.diagnostics)
    wiring = wiring_of(compiled.machine)
    if out is None:
        console = Console()
        width = console.width if console.is_terminal else None
        typer.echo(_drawn(wiring, form, width), nl=False)
        return
    output.save(out, _drawn(wiring, form), _COMMENTS.get(form))
    output.tell_written(out)


def _drawn(wiring: Wiring, form: GraphFormat, width: int | None = None) -> str:
    match form:
        case GraphFormat.SVG:
            return wiring_svg(wiring)
        case GraphFormat.DOT:
            return wiring_dot(wiring)
        case GraphFormat.TEXT:
            return wiring_text(wiring, width)
