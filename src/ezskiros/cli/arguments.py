"""Arguments that several commands take."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

Skills = Annotated[
    list[Path],
    typer.Argument(
        metavar="PATHS...",
        help="Python files, folders with them, packages by their names, and scenes (.turtle).",
        readable=False,
    ),
]
OptionalSkills = Annotated[
    list[Path] | None,
    typer.Argument(
        metavar="[PATHS...]",
        help="Python files, folders with them, and packages by their names; else this folder.",
        readable=False,
        show_default=False,
    ),
]
Folders = Annotated[
    list[Path] | None,
    typer.Option("--ontology", metavar="PATH", help="Files and folders for `load()`.", exists=True),
]
Knowledge = Annotated[
    Path | None,
    typer.Option("--knowledge", metavar="FILE", help="What `ezskiros learn` wrote."),
]
OutFile = Annotated[
    Path | None, typer.Option("--out", "-o", metavar="FILE", help="Write this file.")
]


def name_ontology(paths: list[Path] | None) -> None:
    """Name the ontology that `load()` loads without a path."""
    from ezskiros.ontology.load import VARIABLE

    if paths:
        os.environ[VARIABLE] = os.pathsep.join(map(str, paths))
