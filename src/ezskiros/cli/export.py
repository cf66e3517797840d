"""`ezskiros export`: skills as a file for other languages."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from dslkit.diagnostics import Collector
from dslkit.options import Force
from dslkit.writing import reason
from ezskiros.cli.arguments import Folders, Skills, name_ontology
from ezskiros.cli.checking import asked
from ezskiros.cli.output import output


def export(
    paths: Skills,
    out: Annotated[
        Path,
        typer.Option("--out", "-o", metavar="FILE", help="The output file, such as skills.json."),
    ],
    ontology: Folders = None,
    force: Force = False,
) -> None:
    """Write the description of skills for rules: `skills.json`. Errors prevent the export."""
    output.permit(force)
    if (
        out.suffix != ".json"
    ):  # rules read no other ending, and the export must not replace a Python module
        output.fail(f"{out} does not end in .json; choose another --out", exit_code=2)
    output.try_file(out)
    name_ontology(ontology)
    found, report = asked(_Exporting(paths, out).run)
    if output.exit_code(report.diagnostics):
        output.reject(report.diagnostics)
    output.print_findings(report.diagnostics)
    output.save(out, found["text"])


@dataclass(frozen=True)
class _Exporting:
    """An export, run in the process that executes users' code."""

    paths: list[Path]
    out: Path

    def run(self, collector: Collector) -> dict[str, str | None]:
        """The text of the file; None if there are errors."""
        from ezskiros.confinement import RefusedError
        from ezskiros.driver import export_paths

        try:
            return {"text": export_paths(self.paths, self.out, collector)}
        except OSError as problem:
            raise RefusedError(f"cannot read {problem.filename}: {reason(problem)}") from None
