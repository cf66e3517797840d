"""`ezskiros show`: draws the behavior trees of a compound skill, or writes them for
BehaviorTree.CPP.
"""

from __future__ import annotations

import enum
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from dslkit.diagnostics import Collector, Diagnostic
from dslkit.options import Force
from dslkit.ownership import Comment
from ezskiros.cli.arguments import Folders, OptionalSkills, OutFile, name_ontology
from ezskiros.cli.checking import asked
from ezskiros.cli.output import output

if TYPE_CHECKING:  # imported late, because every command would wait for these imports
    from rich.console import Console


class PictureFormat(str, enum.Enum):
    """The formats in which `show` draws."""

    TEXT = "text"
    SVG = "svg"
    BTCPP = "btcpp"


def show(
    skill: Annotated[
        str, typer.Argument(metavar="SKILL", help="A skill, or one of its implementations.")
    ],
    paths: OptionalSkills = None,
    form: Annotated[
        PictureFormat,
        typer.Option("--format", help="The output format; btcpp is BehaviorTree.CPP 4."),
    ] = PictureFormat.TEXT,
    out: OutFile = None,
    depth: Annotated[
        int, typer.Option(min=0, help="The number of drawn levels of nested compound skills.")
    ] = 0,
    conditions: Annotated[bool, typer.Option(help="Show the conditions of the skills.")] = True,
    ontology: Folders = None,
    force: Force = False,
) -> None:
    """Draw the behavior trees of a compound skill, one for each branch of `expandBT`."""
    from ezskiros.cli.outlines import console_for_outlines, plain_console

    output.permit(force)
    output.try_file(out)
    name_ontology(ontology)
    console = console_for_outlines() if out is None else plain_console()
    picture = _Picture(skill, paths or [Path()], depth, conditions, console, form)
    drawn, report = asked(picture.drawn)
    if form is PictureFormat.BTCPP:
        _end_without_export(drawn, report.diagnostics)
    if out is not None:
        output.save(out, drawn, Comment.HASH if form is PictureFormat.TEXT else None)
    else:
        typer.echo(drawn, nl=False, color=console.is_terminal)
    if output.exit_code(report.diagnostics):
        output.complain("these files have errors: run `ezskiros check` to see them")
    raise typer.Exit(output.exit_code(report.diagnostics))


@dataclass(frozen=True)
class _Picture:
    """The drawing in one format. Text is laid out for a console."""

    skill: str
    paths: list[Path]
    depth: int
    has_conditions: bool
    console: Console
    form: PictureFormat

    def drawn(self, collector: Collector) -> str:
        """The text of the drawing; empty if errors prevent the export to BehaviorTree.CPP."""
        from ezskiros.cli.outlines import outlines_text
        from ezskiros.drawing.btcpp import export
        from ezskiros.drawing.outline import outline
        from ezskiros.drawing.svg import svg
        from ezskiros.driver import check_paths, trees_of

        checked = check_paths(self.paths, collector=collector)
        trees = trees_of(self.skill, checked)
        depth, library = self.depth, checked.library
        if self.form is PictureFormat.BTCPP:
            if output.exit_code(checked.diagnostics):
                return ""
            text, wrong = export(trees, checked.trees, library, depth=depth)
            collector.extend(wrong)
            return text
        outlines = [
            outline(tree, checked.trees, library, depth=depth, has_conditions=self.has_conditions)
            for tree in trees
        ]
        if self.form is PictureFormat.SVG:
            return svg(outlines)
        return outlines_text(outlines, self.console)


def _end_without_export(text: str, found: Sequence[Diagnostic]) -> None:
    """Print the findings on XML for BehaviorTree.CPP; an error ends the run."""
    from rich.console import Console

    from ezskiros.drawing import errors

    if not text:
        output.reject(found)
    own = {each.code for each in errors.ALL}
    wrong = [each for each in found if each.code in own]
    if output.exit_code(wrong):
        output.print_findings(wrong)
        raise typer.Exit(output.exit_code(wrong))
    output.print_findings(wrong, Console(stderr=True, highlight=False))
