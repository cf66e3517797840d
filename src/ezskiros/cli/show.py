"""`ezskiros show`: the behavior trees of a compound skill, drawn or for BehaviorTree.CPP."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from dslkit.command_line import Force
from dslkit.diagnostics import Collector, Diagnostic
from ezskiros.cli.arguments import Folders, OptionalSkills, name_ontology
from ezskiros.cli.checking import asked
from ezskiros.cli.output import output

if TYPE_CHECKING:  # every command waits for what is imported here
    from rich.console import Console


def show(
    skill: Annotated[
        str, typer.Argument(metavar="SKILL", help="A skill, or one of its implementations.")
    ],
    paths: OptionalSkills = None,
    svg: Annotated[
        Path | None, typer.Option("--svg", metavar="FILE", help="Write a picture instead.")
    ] = None,
    btcpp: Annotated[
        Path | None,
        typer.Option(
            "--btcpp", metavar="FILE", help="Write XML for BehaviorTree.CPP 4 and Groot2 instead."
        ),
    ] = None,
    depth: Annotated[
        int, typer.Option(min=0, help="How many levels of compound skills inside it are drawn.")
    ] = 0,
    conditions: Annotated[bool, typer.Option(help="With the conditions of the skills.")] = True,
    ontology: Folders = None,
    force: Force = False,
) -> None:
    """Draw the behavior trees of a compound skill: several if `expandBT` branches."""
    output.permit(force)
    from ezskiros.cli.outlines import console_for_outlines

    output.try_file(svg, btcpp)
    name_ontology(ontology)
    console = console_for_outlines() if svg is None and btcpp is None else None
    picture = _Picture(skill, paths or [Path()], depth, conditions, console, btcpp is not None)
    drawn, report = asked(picture.drawn)
    if btcpp is not None:
        _export(drawn["btcpp"], report.diagnostics, btcpp)
    if svg is not None:
        output.save(svg, drawn["svg"])
    if console is not None:
        typer.echo(drawn["text"], nl=False, color=console.is_terminal)
    if output.exit_code(report.diagnostics):
        output.complain("there are errors in these files: run `ezskiros check`, then look again")
    raise typer.Exit(output.exit_code(report.diagnostics))


@dataclass(frozen=True)
class _Picture:
    """The drawing: as text if there is a console, and for BehaviorTree.CPP if exported."""

    skill: str
    paths: list[Path]
    depth: int
    has_conditions: bool
    console: Console | None
    is_exported: bool

    def drawn(self, collector: Collector) -> dict[str, str]:
        """The texts of it; of what has errors there is none for BehaviorTree.CPP."""
        from ezskiros.cli.outlines import outlines_text
        from ezskiros.drawing.btcpp import export
        from ezskiros.drawing.outline import outline
        from ezskiros.drawing.svg import svg
        from ezskiros.driver import check_paths, trees_of

        checked = check_paths(self.paths, collector=collector)
        trees = trees_of(self.skill, checked)
        depth, library = self.depth, checked.library
        outlines = [
            outline(tree, checked.trees, library, depth=depth, has_conditions=self.has_conditions)
            for tree in trees
        ]
        found = {"svg": svg(outlines), "btcpp": ""}
        if self.console is not None:
            found["text"] = outlines_text(outlines, self.console)
        if self.is_exported and not output.exit_code(checked.diagnostics):
            found["btcpp"], wrong = export(trees, checked.trees, library, depth=depth)
            collector.extend(wrong)
        return found


def _export(text: str, found: Sequence[Diagnostic], path: Path) -> None:
    """Write XML for BehaviorTree.CPP; ends the run if that cannot be."""
    from ezskiros.drawing import errors

    if not text:
        output.reject(found)
    own = {each.code for each in errors.ALL}
    wrong = [each for each in found if each.code in own]
    output.print_findings(wrong)
    if output.exit_code(wrong):
        raise typer.Exit(output.exit_code(wrong))
    output.save(path, text)
