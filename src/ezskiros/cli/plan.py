"""`ezskiros plan`: which skills lead from a scene to a goal."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Annotated

import typer

from ezskiros.cli.arguments import Folders, OptionalSkills, name_ontology
from ezskiros.cli.output import output


def plan(
    goal: Annotated[
        str,
        typer.Option(
            metavar="GOAL",
            help="`(skiros:contain skiros:Location-1 skiros:Product-2)`, or several.",
        ),
    ],
    scene: Annotated[
        Path, typer.Option(metavar="FILE", help="The world that it starts in (.turtle).")
    ],
    paths: OptionalSkills = None,
    write: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Write it as a compound skill, too.")
    ] = None,
    seconds: Annotated[float, typer.Option(min=0.1, help="How long it may take.")] = 60.0,
    ontology: Folders = None,
) -> None:
    """Find skills that lead from a scene to a goal: a behavior tree, checked and tried out."""
    from ezskiros.driver import check_paths
    from ezskiros.planning.plan import find_plan
    from ezskiros.planning.solve import NoPlannerError

    if write is not None and (write.suffix != ".py" or not write.stem.isidentifier()):
        output.fail(f"`{write}` is no file for a module of Python, such as plan.py", exit_code=2)
    if write is not None:
        output.try_file(write)
    name_ontology(ontology)
    paths = paths or [Path()]
    checked = check_paths(paths)
    if output.exit_code(checked.diagnostics):
        output.reject(checked.diagnostics)
    try:
        found, said = find_plan(checked.library, scene, goal, seconds)
    except NoPlannerError as problem:
        output.fail(str(problem), exit_code=2)
    output.print_findings(said)
    if found is None:
        raise typer.Exit(output.exit_code(said) or 1)
    if not found.steps:
        return
    from ezskiros.cli.outlines import print_outlines
    from ezskiros.planning.drawn import drawn
    from ezskiros.planning.source import other_folder, source

    print_outlines([drawn(found)])
    if write is not None:
        folder = other_folder(found, write)
        if folder is not None:
            output.fail(
                f"from {write} the skills cannot be imported: write to {folder}", exit_code=2
            )
        _write(write, source(found, write.stem, goal), paths)


def _write(path: Path, text: str, paths: list[Path]) -> None:
    """Write a plan as a skill, and check it with the skills that it is made of."""
    output.save(path, text)
    # In a process of its own: here the modules of the skills are known, wherever they are.
    command = [sys.executable, "-m", "ezskiros", "check", *map(str, (path, *paths))]
    done = subprocess.run(command, check=False)
    raise typer.Exit(done.returncode)
