"""`ezskiros example`: lists or copies the included examples."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from dslkit.examples import UnknownExampleError, named
from dslkit.options import Force
from ezskiros.cli.output import output

_SUMMARIES = {
    "pick_place": "an arm picks and places objects: skills, an ontology, a scene",
    "whiteboard": "an arm erases whiteboards: skills and rules, also for `crosscheck`",
}
_PACKAGE = Path(__file__).parents[1]
_HOMES = (_PACKAGE / "examples", _PACKAGE.parents[1] / "examples")
"""The folder of the examples in a wheel, and the folder in the repository."""


def example(
    name: Annotated[
        str | None,
        typer.Argument(metavar="EXAMPLE", help="The name of an example, such as pick_place."),
    ] = None,
    folder: Annotated[
        Path | None, typer.Argument(metavar="DIR", help="The output folder; default: ./EXAMPLE.")
    ] = None,
    force: Force = False,
) -> None:
    """Copy skills with their ontology and a scene; without EXAMPLE, list the examples."""
    output.permit(force)
    if name is None:
        width = max(map(len, _SUMMARIES))
        for each, summary in _SUMMARIES.items():
            typer.echo(f"{each:{width}}  {summary}")
        return
    try:
        wanted = named({each: each for each in _SUMMARIES}, name, "example")
    except UnknownExampleError as error:
        output.fail(str(error), exit_code=2)
    target = folder or Path(wanted)
    output.copy_example(_folder_of(wanted), target)
    typer.echo(f"now try: ezskiros check {target / 'skills'}")


def _folder_of(name: str) -> Path:
    return next(home / name for home in _HOMES if (home / name).is_dir())
