"""`ezskiros show`: the behavior trees of a compound skill, drawn or for BehaviorTree.CPP."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ezskiros.cli.arguments import Folders, OptionalSkills, name_ontology
from ezskiros.cli.output import output

if TYPE_CHECKING:  # users wait for what is imported
    from ezskiros.driver import Checked
    from ezskiros.trees.tree import Tree


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
) -> None:
    """Draw the behavior trees of a compound skill: several if `expandBT` branches."""
    from ezskiros.drawing.outline import outline
    from ezskiros.driver import UnknownSkillError, check_paths, trees_of

    for path in (svg, btcpp):
        if path is not None:
            output.try_file(path)
    name_ontology(ontology)
    checked = check_paths(paths or [Path()])
    try:
        trees = trees_of(skill, checked)
    except UnknownSkillError as problem:
        output.print_findings(checked.diagnostics)
        output.fail(str(problem), exit_code=2)
    if btcpp is not None:
        _export(checked, trees, btcpp, depth)
    outlines = [
        outline(tree, checked.trees, checked.library, depth=depth, has_conditions=conditions)
        for tree in trees
    ]
    if svg is not None:
        from ezskiros.drawing.svg import svg as picture

        output.save(svg, picture(outlines))
    if svg is None and btcpp is None:
        from ezskiros.cli.outlines import print_outlines

        print_outlines(outlines)
    if output.exit_code(checked.diagnostics):
        output.complain("there are errors in these files: run `ezskiros check`, then look again")
    raise typer.Exit(output.exit_code(checked.diagnostics))


def _export(checked: Checked, trees: list[Tree], path: Path, depth: int) -> None:
    """Write XML for BehaviorTree.CPP; ends the run if that cannot be."""
    from ezskiros.drawing.btcpp import export

    if output.exit_code(checked.diagnostics):
        output.reject(checked.diagnostics)
    text, found = export(trees, checked.trees, checked.library, depth=depth)
    output.print_findings(found)
    if output.exit_code(found):
        raise typer.Exit(output.exit_code(found))
    output.save(path, text)
