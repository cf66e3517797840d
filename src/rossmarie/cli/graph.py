"""`rossmarie graph`: the wiring of a rules file, printed or written."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path

import typer
from rich.console import Console

from dslkit.diagnostics.render_json import Json
from dslkit.ownership import Comment
from rossmarie.cli.choices import GraphFormat
from rossmarie.cli.output import output
from rossmarie.driver import RulesError, compile_file
from rossmarie.report.wiring import NodeWiring, wiring_dot, wiring_of, wiring_svg, wiring_text
from rossmarie.report.wiring.model import EffectUse

_RULES = ".ross"
_COMMENTS = {GraphFormat.DOT: Comment.SLASHES, GraphFormat.TEXT: Comment.HASH}


def run_graph(
    rules: Path,
    form: GraphFormat,
    out: Path | None,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
) -> None:
    """Print the wiring, or write it to `out`. A rules file is not overwritten."""
    with output.answering(form, "graph", files=1) as answer:
        if out is not None and out.suffix == _RULES:
            output.fail(f"{out} would be a rules file; choose another --out", exit_code=2)
        output.try_file(out)
        try:
            compiled = compile_file(rules, systems=systems, message_folders=message_folders)
        except RulesError as error:
            output.reject(error.diagnostics)
        wiring = wiring_of(compiled.machine)
        answer.result = wiring_result(wiring)
        if out is not None:
            output.save(out, _drawn(wiring, form), _COMMENTS.get(form))
            output.tell_written(out)
        elif not answer.is_printed:
            console = Console()
            width = console.width if console.is_terminal else None
            typer.echo(_drawn(wiring, form, width), nl=False)


def _drawn(wiring: NodeWiring, form: GraphFormat, width: int | None = None) -> str:
    match form:
        case GraphFormat.SVG:
            return wiring_svg(wiring)
        case GraphFormat.DOT:
            return wiring_dot(wiring)
        case GraphFormat.TEXT:
            return wiring_text(wiring, width)
        case GraphFormat.JSON:
            return json.dumps({"generator": output.tool, **wiring_result(wiring)}, indent=2) + "\n"


def wiring_result(wiring: NodeWiring) -> Mapping[str, Json]:
    """The topics, commands and other resources of a node. Times are in ns."""
    return {
        "node": wiring.node,
        "inputs": [{**asdict(each), "rules": list(each.rules)} for each in wiring.inputs],
        "commands": [{**asdict(each), "uses": _uses(each.uses)} for each in wiring.commands],
        "outputs": [
            {**asdict(each), "kind": each.kind.value, "uses": _uses(each.uses)}
            for each in wiring.outputs
        ],
        "remark": wiring.remark,
    }


def _uses(uses: Sequence[EffectUse]) -> list[Json]:
    return [{**asdict(each), "rules": list(each.rules)} for each in uses]
