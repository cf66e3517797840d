"""The `crosscheck` command: one function per subcommand.

Exit codes: 0 for no errors (there may be warnings), 1 for findings, 2 for a wrong call, an
unreadable file or a missing ROS, 70 for a defect of this tool.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from crosscheck.cli.choices import Answers, ShowFormat, ros_namespace
from crosscheck.cli.output import output
from dslkit.completion import codes
from dslkit.options import Force, Format, ReportFormat, StudyFile
from dslkit.parameters import Group
from dslkit.writing import reason
from rossmarie.cli.options import MessageFolders, OptionalOutFile, Rules, Systems

app = typer.Typer(
    help="Check rules and skills of one robot together.",
    cls=Group,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
    context_settings={"help_option_names": ["-h", "--help"]},
)


@app.callback()
def crosscheck(version: Annotated[bool, output.version_option()] = False) -> None:
    """Check rules and skills of one robot together."""


@app.command()
def check(
    rules: Rules,
    form: Annotated[
        Format, typer.Option("--format", help="The format of the findings.")
    ] = Format.TEXT,
    scene: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="The initial scene of the robot (.turtle).", readable=False
        ),
    ] = None,
    system: Systems = None,
    messages: MessageFolders = None,
    study: StudyFile = None,
) -> None:
    """Report errors between rules and skills."""
    with output.answering(form, "check", files=1):
        from crosscheck.check import check_robot

        output.try_study(study)
        try:
            found = check_robot(
                rules, systems=system or [], message_folders=messages or [], scene=scene
            )
        except OSError as problem:
            if scene is None:
                raise
            output.fail(f"cannot read {scene}: {reason(problem)}", exit_code=2)
        output.log_study(study, "check", [rules], found)
        output.print_diagnostics(found, form, file_count=1)
        raise typer.Exit(output.exit_code(found))


@app.command()
def show(
    rules: Rules,
    form: Annotated[
        ShowFormat, typer.Option("--format", help="The format of the picture.")
    ] = ShowFormat.TEXT,
    out: OptionalOutFile = None,
    system: Systems = None,
    messages: MessageFolders = None,
    force: Force = False,
) -> None:
    """Show the resources of each skill, and the rules that guard or interrupt the skill."""
    output.permit(force)
    from crosscheck.cli.showing import run_show

    run_show(rules, form, out, system or [], messages or [])


@app.command()
def impact(
    skill: Annotated[str, typer.Argument(metavar="SKILL", help="The name of a description.")],
    rules: Rules,
    form: Answers = ReportFormat.TEXT,
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """List the trees and rules that a change to one description can break."""
    from crosscheck.cli.showing import run_impact

    run_impact(skill, rules, form, system or [], messages or [])


@app.command()
def weave(
    rules: Rules,
    out: Annotated[
        Path,
        typer.Option("--out", "-o", metavar="FILE", help="The output file, such as guards.json."),
    ],
    system: Systems = None,
    messages: MessageFolders = None,
    force: Force = False,
) -> None:
    """Write the rules for which each primitive skill must wait before it starts."""
    output.permit(force)
    from crosscheck.cli.weaving import run_weave

    run_weave(rules, out, system or [], messages or [])


@app.command()
def live(
    rules: Rules,
    namespace: Annotated[
        str,
        typer.Option(
            metavar="NS", help="The namespace of the robot, such as /robot1.", parser=ros_namespace
        ),
    ] = "",
    duration: Annotated[
        float | None, typer.Option(metavar="SECONDS", min=0.0, help="End after this time.")
    ] = None,
    form: Answers = ReportFormat.TEXT,
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """Monitor a running robot over ROS: its skills, its active rules, and errors."""
    from crosscheck.cli.watching import run_live

    run_live(rules, namespace, duration, form, system or [], messages or [])


@app.command()
def explain(
    code: Annotated[
        str,
        typer.Argument(
            metavar="CODE",
            help="A code or name, such as CHK102.",
            autocompletion=codes("crosscheck"),
        ),
    ],
) -> None:
    """Explain a diagnostic."""
    output.explain(code)


def main() -> None:
    """Run the command line."""
    output.run(app)
