"""`ezskiros owl`: the ontology as SkiROS2 loads it."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

import typer

from dslkit.options import Force
from dslkit.ownership import is_own
from ezskiros.cli.arguments import Folders, name_ontology
from ezskiros.cli.output import output

_HEAD = 4096


def owl(
    out: Annotated[
        Path,
        typer.Option(
            "--out", "-o", metavar="DIR", help="SkiROS2's `workspace_dir`, or a folder in it."
        ),
    ],
    ontology: Folders = None,
    force: Force = False,
) -> None:
    """Write the ontology for SkiROS2: RDF/XML files (`.owl`)."""
    output.permit(force)
    output.try_folder(out)
    from ezskiros.driver import owl_of

    name_ontology(ontology)
    files, found = owl_of()
    if output.exit_code(found):
        output.reject(found)
    output.print_findings(found)
    texts = {out / name: text for name, text in files.items()}
    output.try_folder(out, *files)
    with output.writing_to(out):
        out.mkdir(parents=True, exist_ok=True)
    for path, text in texts.items():
        output.save(path, text)
        output.tell_written(path)
    _tell_left(out, texts)


def _tell_left(folder: Path, written: Iterable[Path]) -> None:
    """Report files of earlier runs, which SkiROS2 would load together with the new files."""
    from ezskiros.hosts.owl_files import START

    for path in sorted({*folder.glob(f"{START}*.owl")} - {*written}):
        if _is_own(path):
            output.complain(f"{path} is left from an earlier ontology: delete it")


def _is_own(path: Path) -> bool:
    with output.writing(path), path.open("rb") as opened:
        return is_own(opened.read(_HEAD), output.tool)
