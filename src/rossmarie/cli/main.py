"""The `rossmarie` command: one function per subcommand.

Exit codes: 0 success (warnings may have been printed), 1 errors were found or the task failed, 2
the command was called wrongly or a file could not be read, 70 a defect of this tool. A subcommand
imports its own modules itself, so that the other subcommands start fast.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from dslkit.options import Force, Format, ReportFormat, StudyFile
from dslkit.parameters import Group
from rossmarie.cli.beginnings import example, init, model
from rossmarie.cli.choices import DumpFormat, GraphFormat, StageName, TargetName
from rossmarie.cli.options import (
    AnswerFormat,
    Code,
    Compared,
    CoverageFile,
    CoverageReport,
    Licenses,
    ListOfSources,
    Maintainers,
    MessageFolders,
    Only,
    OptionalOutFile,
    OutFile,
    ProofsFile,
    ProofsReport,
    ProverFolder,
    ProverTimeout,
    Recordings,
    ReportFolder,
    ReviewPage,
    Rules,
    RulesFiles,
    Systems,
    Toggle,
    TopicMap,
    WithSkills,
    Witnesses,
    choice,
    ros_name,
    written,
)
from rossmarie.cli.output import output

app = typer.Typer(
    help="Check safety rules for robots, generate their monitor, and replay recordings.",
    cls=Group,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
    context_settings={"help_option_names": ["-h", "--help"]},
)


@app.callback()
def rossmarie(version: Annotated[bool, output.version_option()] = False) -> None:
    """Check safety rules for robots, generate their monitor, and replay recordings."""


@app.command()
def check(
    files: RulesFiles,
    format: Annotated[  # noqa: A002
        Format, choice(Format, "The format of the findings.")
    ] = Format.TEXT,
    target: Annotated[
        TargetName | None,
        choice(TargetName, "Also report rules that this target does not support."),
    ] = None,
    thorough: Annotated[
        bool,
        typer.Option("--thorough", help="Run all queries about the rules, and also report proofs."),
    ] = False,
    toggle: Toggle = None,
    witnesses: Witnesses = None,
    skills: WithSkills = False,
    system: Systems = None,
    messages: MessageFolders = None,
    only: Only = None,
    study: StudyFile = None,
    force: Force = False,
) -> None:
    """Check rules files: names, types, units, impossible conditions, and rules that conflict."""
    output.permit(force)
    from rossmarie.cli.check import run_check

    name, systems, folders = target and target.value, system or (), messages or ()
    run_check(
        files,
        format,
        name,
        thorough,
        toggle,
        witnesses,
        skills,
        systems,
        folders,
        only or (),
        study,
    )


@app.command()
def explain(
    code: Code,
) -> None:
    """Explain a diagnostic: its meaning, an example, and the correction."""
    output.explain(code)


@app.command()
def fmt(
    files: RulesFiles,
    check_only: Annotated[
        bool, typer.Option("--check", help="Change no file; exit with 1 if a file would change.")
    ] = False,
) -> None:
    """Format rules files in the standard layout."""
    from rossmarie.cli.formatting import run_fmt

    run_fmt(files, check_only)


@app.command()
def dump(
    rules: Rules,
    after: Annotated[
        StageName, choice(StageName, "The last stage of the compiler that runs.")
    ] = StageName.LOWER,
    format: Annotated[  # noqa: A002
        DumpFormat, choice(DumpFormat, "The output format.")
    ] = DumpFormat.TEXT,
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """Show the result of a compiler stage."""
    from rossmarie.cli.dumping import run_dump

    run_dump(rules, after, format, system or (), messages or ())


@app.command()
def build(
    rules: Rules,
    out: Annotated[
        Path, typer.Option("--out", "-o", metavar="DIR", help="The output folder.", parser=written)
    ],
    target: Annotated[
        TargetName, choice(TargetName, "The target of the generated code.")
    ] = TargetName.C99,
    license: Licenses = None,  # noqa: A002
    maintainer: Maintainers = None,
    part_of: Annotated[
        str | None,
        typer.Option(
            metavar="PACKAGE",
            help="Generate a part of this ROS package; its CMakeLists.txt includes the part.",
            parser=ros_name,
        ),
    ] = None,
    name: Annotated[
        str | None,
        typer.Option(
            metavar="NAME",
            help="The name of the monitor; default: the name of the file.",
            parser=ros_name,
        ),
    ] = None,
    sources: ListOfSources = None,
    review: ReviewPage = None,
    system: Systems = None,
    messages: MessageFolders = None,
    only: Only = None,
    force: Force = False,
) -> None:
    """Generate the monitor of a rules file."""
    output.permit(force)
    from rossmarie.cli.build import PackageOptions, run_build

    package = PackageOptions(tuple(license or ()), tuple(maintainer or ()), part_of)
    run_build(
        rules,
        out,
        target.value,
        package,
        name,
        sources,
        review,
        system or (),
        messages or (),
        only or (),
    )


@app.command()
def graph(
    rules: Rules,
    format: Annotated[  # noqa: A002
        GraphFormat, choice(GraphFormat, "The format of the drawing.")
    ] = GraphFormat.TEXT,
    out: OptionalOutFile = None,
    system: Systems = None,
    messages: MessageFolders = None,
    force: Force = False,
) -> None:
    """Draw the connections of a rules file: inputs, filtered commands and effects of its node."""
    output.permit(force)
    from rossmarie.cli.graph import run_graph

    run_graph(rules, format, out, system or [], messages or [])


@app.command()
def export(
    rules: Rules,
    out: OutFile = Path("rules.json"),
    system: Systems = None,
    messages: MessageFolders = None,
    force: Force = False,
) -> None:
    """Write a description of a rules file for other programs: `rules.json`."""
    output.permit(force)
    from rossmarie.cli.export import run_export

    run_export(rules, out, system or [], messages or [])


@app.command()
def failures(
    rules: Rules,
    format: AnswerFormat = ReportFormat.TEXT,  # noqa: A002
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """List for each input the rules that become active when the input is stale."""
    from rossmarie.cli.failures import run_failures

    run_failures(rules, format, system or [], messages or [])


@app.command()
def report(
    rules: Rules,
    out: OutFile = Path("report.html"),
    verification: ProofsFile = None,
    coverage: CoverageFile = None,
    date: Annotated[
        str | None,
        typer.Option(metavar="YYYY-MM-DD", help="The date in the report; default: today, in UTC."),
    ] = None,
    thorough: Annotated[
        bool,
        typer.Option(
            "--thorough", help="Run all queries about the rules, like `check --thorough`."
        ),
    ] = False,
    system: Systems = None,
    messages: MessageFolders = None,
    only: Only = None,
    force: Force = False,
) -> None:
    """Write the safety file: hazards, rules in sentences, proofs, and open points."""
    output.permit(force)
    from rossmarie.cli.report import run_report

    run_report(
        rules, out, verification, coverage, date, thorough, system or [], messages or [], only or []
    )


@app.command()
def replay(
    rules: Rules,
    recordings: Recordings,
    topic_map: TopicMap = None,
    out: ReportFolder = None,
    compare: Compared = None,
    format: AnswerFormat = ReportFormat.TEXT,  # noqa: A002
    system: Systems = None,
    messages: MessageFolders = None,
    only: Only = None,
    force: Force = False,
) -> None:
    """Run the monitor of a rules file over one or several recordings."""
    output.permit(force)
    chosen, pairs = list(dict.fromkeys(recordings)), topic_map or []
    rest = (pairs, out, format, system or [], messages or [], only or [])
    if len(chosen) == 1 or compare is not None:
        from rossmarie.cli.replay import run_replay

        run_replay(rules, chosen, compare, *rest)
    else:
        from rossmarie.cli.replays import run_replays

        run_replays(rules, chosen, *rest)


@app.command("test")
def run_tests(
    rules: Rules,
    tests: Annotated[
        list[str] | None,
        typer.Argument(metavar="TESTS...", help="Names of tests; `*` matches any text."),
    ] = None,
    write: Annotated[
        bool,
        typer.Option(
            "--write", help="First write tests of all boundaries to the test file of the rules."
        ),
    ] = False,
    junit: Annotated[
        Path | None,
        typer.Option(
            "--junit", metavar="FILE", help="Also write the results as JUnit XML.", parser=written
        ),
    ] = None,
    format: AnswerFormat = ReportFormat.TEXT,  # noqa: A002
    system: Systems = None,
    messages: MessageFolders = None,
    force: Force = False,
) -> None:
    """Run the tests of a rules file in the interpreter and in C, and report their coverage."""
    output.permit(force)
    from rossmarie.cli.testing import run_test

    run_test(
        rules,
        tests or [],
        format,
        write=write,
        junit=junit,
        systems=system or (),
        message_folders=messages or (),
    )


@app.command()
def coverage(
    rules: Rules,
    recordings: Recordings,
    topic_map: TopicMap = None,
    out: CoverageReport = None,
    format: AnswerFormat = ReportFormat.TEXT,  # noqa: A002
    system: Systems = None,
    messages: MessageFolders = None,
    force: Force = False,
) -> None:
    """Report the coverage of rules by recordings, and the margin of each threshold."""
    output.permit(force)
    from rossmarie.cli.testing import run_coverage

    run_coverage(rules, recordings, topic_map or [], format, out, system or [], messages or [])


@app.command()
def verify(
    rules: Rules,
    timeout: ProverTimeout = 120,
    out: ProofsReport = None,
    format: AnswerFormat = ReportFormat.TEXT,  # noqa: A002
    keep: ProverFolder = None,
    system: Systems = None,
    messages: MessageFolders = None,
    only: Only = None,
    force: Force = False,
) -> None:
    """Prove with CBMC that the generated C implements the rules, for runs of any length."""
    output.permit(force)
    from rossmarie.cli.verification import run_verify

    run_verify(
        rules,
        format,
        timeout_s=timeout,
        report=out,
        kept=keep,
        systems=system or (),
        message_folders=messages or (),
        only=only or (),
    )


for _command in (model, init, example):
    app.command()(_command)


def main() -> None:
    """Run the command line."""
    output.run(app)
