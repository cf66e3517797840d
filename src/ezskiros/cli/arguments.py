"""Arguments that several commands take."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

_CHECKERS = {".ross": ("a rules file", "rossmarie check")}
_SKILLS = {"", ".py", ".pyi", ".turtle", ".ttl", ".owl", ".rdf"}


def of_skills(paths: list[Path] | None) -> list[Path] | None:
    """The paths, if they can contain skills. A file of another kind ends the run."""
    for path in paths or ():
        suffix = path.suffix.lower()
        if suffix in _SKILLS or not path.is_file():
            continue
        kind, checker = _CHECKERS.get(suffix, ("", ""))
        if kind:
            raise typer.BadParameter(f"{path} is {kind}: `{checker} {path}` checks it")
        raise typer.BadParameter(f"{path} is neither a Python file nor a folder with Python files")
    return paths


def of_rules(path: Path | None) -> Path | None:
    """The path, if it can be a rules file. A file of another kind ends the run."""
    if path is not None and path.suffix.lower() != ".ross":
        raise typer.BadParameter(f"{path} is not a rules file: its name does not end in .ross")
    return path


Skills = Annotated[
    list[Path],
    typer.Argument(
        metavar="PATHS...",
        help="Python files or folders, names of packages, and scenes (.turtle).",
        callback=of_skills,
        readable=False,
    ),
]
OptionalSkills = Annotated[
    list[Path] | None,
    typer.Argument(
        metavar="[PATHS...]",
        callback=of_skills,
        help="Python files or folders, and names of packages; default: the current folder.",
        readable=False,
        show_default=False,
    ),
]
Folders = Annotated[
    list[Path] | None,
    typer.Option(
        "--ontology", metavar="PATH", help="Ontology files and folders for `load()`.", exists=True
    ),
]
Knowledge = Annotated[
    Path | None,
    typer.Option("--knowledge", metavar="FILE", help="The knowledge file of `ezskiros learn`."),
]
OutFile = Annotated[
    Path | None, typer.Option("--out", "-o", metavar="FILE", help="The output file.")
]


def name_ontology(paths: list[Path] | None) -> None:
    """Select the ontology that `load()` loads without a path."""
    from ezskiros.ontology.load import VARIABLE

    if paths:
        os.environ[VARIABLE] = os.pathsep.join(map(str, paths))
