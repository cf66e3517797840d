"""`ezskiros owl`: the ontology as SkiROS2 loads it."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

import typer

from ezskiros.cli.arguments import Folders, name_ontology
from ezskiros.cli.output import output

_HEAD = 4096


def owl(
    out: Annotated[
        Path,
        typer.Option(
            "--out", "-o", metavar="DIR", help="SkiROS2's `workspace_dir`, or one inside it."
        ),
    ],
    ontology: Folders = None,
) -> None:
    """Write the ontology as SkiROS2 loads it: files in RDF/XML (`.owl`)."""
    output.try_folder(out)
    from ezskiros.driver import owl_of

    name_ontology(ontology)
    files, found = owl_of()
    if output.exit_code(found):
        output.reject(found)
    output.print_findings(found)
    texts = {out / name: text for name, text in files.items()}
    for path in filter(Path.exists, texts):
        _refuse_foreign(path)
        output.try_file(path)
    with output.writing_to(out):
        out.mkdir(parents=True, exist_ok=True)
    for path, text in texts.items():
        output.save(path, text)
        typer.echo(f"wrote {path}")
    _tell_left(out, texts)


def _refuse_foreign(path: Path) -> None:
    """End the run if a file is in the way that this command has not written."""
    if not _is_own(path):
        output.fail(f"{path} is not overwritten: `ezskiros owl` has not written it", exit_code=2)


def _tell_left(folder: Path, written: Iterable[Path]) -> None:
    """Tell of files of earlier runs, which SkiROS2 would load beside those of this one."""
    from ezskiros.hosts.owl_files import START

    for path in sorted({*folder.glob(f"{START}*.owl")} - {*written}):
        if _is_own(path):
            output.complain(f"{path} is left from an earlier ontology: delete it")


def _is_own(path: Path) -> bool:
    from ezskiros.hosts.owl_files import is_own

    if not path.is_file():
        return False
    with output.writing(path), path.open("rb") as opened:
        return is_own(opened.read(_HEAD))
