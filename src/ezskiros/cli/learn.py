"""`ezskiros learn`: learns from the activations of rules while skills ran."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from dslkit.options import Force, ReportFormat
from dslkit.writing import reason
from ezskiros.cli.arguments import Folders, name_ontology
from ezskiros.cli.output import output

if TYPE_CHECKING:  # imported late, because every command would wait for these imports
    from ezskiros.learning.runs import TaskRun
    from ezskiros.learning.scene import Map


def learn(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="VERDICTS... TRACES...",
            help="Verdicts of `rossmarie replay` and traces of `ezskiros run`, in any order.",
            readable=False,
        ),
    ],
    scene: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="A scene with the locations (.turtle)."),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out", "-o", metavar="FILE", help="The output file, such as knowledge.json."
        ),
    ] = None,
    form: Annotated[
        ReportFormat, typer.Option("--format", help="The format of findings and result.")
    ] = ReportFormat.TEXT,
    ontology: Folders = None,
    force: Force = False,
) -> None:
    """Learn from recorded runs: rules that became active, skills that failed, and their cost."""
    output.permit(force)
    with output.answering(form, "learn", files=len(files)) as answer:
        if out is not None:
            if out.suffix != ".json":  # the output must not replace a record
                output.fail(f"{out} does not end in .json; choose another --out", exit_code=2)
            output.try_file(out)
        name_ontology(ontology)
        from ezskiros.learning.knowledge import known, text_of
        from ezskiros.learning.learn import learn as lessons_of

        places = _places(scene)
        runs = _runs(files)
        lessons = lessons_of(runs, places.locations.keys())
        text = text_of(known(lessons, runs, out.parent if out is not None else Path()))
        answer.result = json.loads(text)
        if not answer.is_printed:
            from rich.console import Console

            from ezskiros.learning.proposals import proposals
            from ezskiros.learning.report import print_report

            print_report(lessons, Console(highlight=False), places.short)
            for number, text_to_paste in enumerate(proposals(lessons, places)):
                typer.echo("\n" if number else "\nProposals\n\n", nl=False)
                typer.echo(text_to_paste)
        if out is not None:
            output.save(out, text)


def _places(scene: Path | None) -> Map:
    """The locations in a scene. The run ends if the scene has errors."""
    from ezskiros.learning.scene import Map, read_map

    if scene is None:
        return Map()
    try:
        found, wrong = read_map(scene)
    except OSError as problem:
        output.fail(f"cannot read {scene}: {reason(problem)}", exit_code=2)
    if found is None:
        output.reject(wrong)
    return found


def _runs(files: Sequence[Path]) -> Sequence[TaskRun]:
    """The runs in some files. The command ends if a file has errors."""
    from ezskiros.learning.runs import read_runs

    try:
        runs, wrong = read_runs(files)
    except OSError as problem:
        output.fail(f"cannot read {problem.filename}: {reason(problem)}", exit_code=2)
    if wrong:
        output.reject(wrong)
    return runs
