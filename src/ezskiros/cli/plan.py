"""`ezskiros plan`: finds skills that lead from a scene to a goal."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from dslkit.diagnostics import Collector
from dslkit.options import Force, Format
from dslkit.ownership import Comment
from ezskiros.cli.arguments import Folders, Knowledge, OptionalSkills, name_ontology
from ezskiros.cli.checking import asked, checked, lessons_of, print_check
from ezskiros.cli.output import output

if TYPE_CHECKING:  # imported late, because every command would wait for these imports
    from rich.console import Console

    from ezskiros.learning.lessons import Lessons
    from ezskiros.planning.plan import Plan


def plan(
    goal: Annotated[
        str,
        typer.Option(
            metavar="GOAL",
            help="One or several facts: `(skiros:contain skiros:Location-1 skiros:Product-2)`.",
        ),
    ],
    scene: Annotated[Path, typer.Option(metavar="FILE", help="The initial scene (.turtle).")],
    paths: OptionalSkills = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            "-o",
            metavar="FILE",
            help="Also write the plan as a compound skill to this file.",
        ),
    ] = None,
    timeout: Annotated[
        float, typer.Option(metavar="SECONDS", min=0.1, help="Stop the search after this time.")
    ] = 60.0,
    knowledge: Knowledge = None,
    ontology: Folders = None,
    force: Force = False,
) -> None:
    """Find a plan from a scene to a goal: a behavior tree, checked and simulated."""
    output.permit(force)
    if out is not None and (out.suffix != ".py" or not out.stem.isidentifier()):
        output.fail(
            f"`{out}` is not the file name of a Python module, such as plan.py", exit_code=2
        )
    output.try_file(out)
    lessons, wrong = lessons_of(knowledge)
    if wrong:
        output.reject(wrong)
    name_ontology(ontology)
    paths = paths or [Path()]
    report = checked(paths)
    if output.exit_code(report.diagnostics):
        output.reject(report.diagnostics)
    from ezskiros.cli.outlines import console_for_outlines

    console = console_for_outlines()
    # The search for unreachable facts, and the search for a plan, may take this long each.
    search = _Search(paths, scene, goal, timeout, out, console, lessons)
    found, report = asked(search.run, 2 * timeout, may_act=True)
    output.print_findings(report.diagnostics)
    if not found["has_plan"]:
        raise typer.Exit(output.exit_code(report.diagnostics) or 1)
    typer.echo(found["text"], nl=False, color=console.is_terminal)
    if out is None or not found["text"]:
        return
    if found["folder"]:
        folder = found["folder"]
        output.fail(f"a plan in {out} cannot import the skills: write it to {folder}", exit_code=2)
    _write(out, found["source"], paths)


@dataclass(frozen=True)
class _Search:
    """The search for a plan. It starts the planner as a process, so it is allowed to act."""

    paths: list[Path]
    scene: Path
    goal: str
    timeout_s: float
    write: Path | None
    console: Console
    lessons: Lessons | None

    def run(self, collector: Collector) -> dict[str, Any]:
        """The plan as text, and as source code if a file is to be written."""
        from ezskiros.cli.outlines import outlines_text
        from ezskiros.confinement import RefusedError
        from ezskiros.driver import check_paths
        from ezskiros.planning.drawn import drawn
        from ezskiros.planning.plan import find_plan
        from ezskiros.planning.solve import NoPlannerError
        from ezskiros.planning.source import other_folder, source

        library = check_paths(self.paths).library
        try:
            costs = self.lessons.costs if self.lessons is not None else ()
            plan, said = find_plan(library, self.scene, self.goal, self.timeout_s, costs)
        except NoPlannerError as problem:
            raise RefusedError(str(problem)) from None
        collector.extend(said)
        found: dict[str, Any] = {"has_plan": plan is not None, "text": ""}
        if plan is not None and plan.steps:
            found["text"] = outlines_text([drawn(plan)], self.console)
            if self.lessons is not None:
                found["text"] += f"{_expected(plan, self.lessons)}\n"
            if self.write is not None:
                folder = other_folder(plan, self.write)
                found["folder"] = str(folder) if folder else None
                found["source"] = "" if folder else source(plan, self.write.stem, self.goal)
        return found


def _expected(plan: Plan, lessons: Lessons) -> str:
    """The expected loss of a plan in seconds, and the number of runs behind this number."""
    runs = f"{lessons.runs} run{'s' if lessons.runs != 1 else ''}"
    return f"expected to lose {plan.expected_s:.1f} s to rules, after {runs}"


def _write(path: Path, text: str, paths: list[Path]) -> None:
    """Write a plan as a skill, and check the skill together with the skills of its steps."""
    output.save(path, text, Comment.HASH)
    raise typer.Exit(print_check([path, *paths], None, Format.TEXT))
