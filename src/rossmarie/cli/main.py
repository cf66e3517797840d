"""The `rossmarie` command: one function per subcommand.

Exit codes: 0 success (warnings may have been printed), 1 errors were found or the task failed, 2
the command was called wrongly or a file could not be read, 70 a defect of this tool. A subcommand
imports its own modules itself, so that the other subcommands start fast.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from dslkit.command_line import Format, ReportFormat, StudyFile
from dslkit.parameters import Group
from rossmarie.cli.beginnings import example, init, model
from rossmarie.cli.choices import DumpFormat, GraphFormat, StageName, TargetName
from rossmarie.cli.options import (
    AnswerFormat,
    Code,
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
    TopicMap,
    WithSkills,
    choice,
    ros_name,
    written,
)
from rossmarie.cli.output import output

app = typer.Typer(
    help="Safety rules for robots: check them, build their monitor, replay a recording.",
    cls=Group,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
    context_settings={"help_option_names": ["-h", "--help"]},
)


@app.callback()
def rossmarie(version: Annotated[bool, output.version_option()] = False) -> None:
    """Safety rules for robots: check them, build their monitor, replay a recording."""


@app.command()
def check(
    files: RulesFiles,
    format: Annotated[  # noqa: A002
        Format, choice(Format, "How findings are printed.")
    ] = Format.TEXT,
    target: Annotated[
        TargetName | None, choice(TargetName, "Also report what this target cannot do.")
    ] = None,
    thorough: Annotated[
        bool, typer.Option("--thorough", help="Ask all queries, and tell proofs as well.")
    ] = False,
    toggle: Annotated[
        float,
        typer.Option(
            metavar="SECONDS", min=0.0, help="With --thorough: how soon no rule may toggle."
        ),
    ] = 1.0,
    witnesses: Annotated[
        Path | None,
        typer.Option(
            metavar="PATH",
            help="Write what shows a finding into this folder, or as tests into a .ross file.",
            parser=written,
        ),
    ] = None,
    skills: WithSkills = False,
    system: Systems = None,
    messages: MessageFolders = None,
    only: Only = None,
    study: StudyFile = None,
) -> None:
    """Check rules files: names, types, units, what cannot work, and what rules mean together."""
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
    """Explain a diagnostic: what it means, an example, what to write instead."""
    output.explain(code)


@app.command()
def fmt(
    files: RulesFiles,
    check_only: Annotated[
        bool, typer.Option("--check", help="Change nothing; exit with 1 if something would.")
    ] = False,
) -> None:
    """Write rules files in the one layout."""
    from rossmarie.cli.formatting import run_fmt

    run_fmt(files, check_only)


@app.command()
def dump(
    rules: Rules,
    after: Annotated[StageName, choice(StageName, "The stage to stop after.")] = StageName.LOWER,
    format: Annotated[  # noqa: A002
        DumpFormat, choice(DumpFormat, "How it is written.")
    ] = DumpFormat.TEXT,
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """Show what the compiler holds after a stage."""
    from rossmarie.driver import RulesError
    from rossmarie.driver.dump import JSON_STAGES, Stage
    from rossmarie.driver.dump import dump as dump_stage

    stage, as_json = Stage(after.value), format is DumpFormat.JSON
    if as_json and stage not in JSON_STAGES:
        those = " or ".join(one.value for one in JSON_STAGES)
        output.fail(f"--after {stage.value} has no JSON form; {those} has", exit_code=2)
    try:
        text = dump_stage(
            rules, stage, as_json=as_json, systems=system or (), message_folders=messages or ()
        )
    except RulesError as error:
        output.reject(error.diagnostics)
    typer.echo(text, nl=False)


@app.command()
def build(
    rules: Rules,
    out: Annotated[
        Path, typer.Option("--out", "-o", metavar="DIR", help="Where to write.", parser=written)
    ],
    target: Annotated[TargetName, choice(TargetName, "What to generate.")] = TargetName.C99,
    license: Licenses = None,  # noqa: A002
    maintainer: Maintainers = None,
    part_of: Annotated[
        str | None,
        typer.Option(
            metavar="PACKAGE",
            help="Generate a part of this ROS package, for its CMakeLists.txt to include.",
            parser=ros_name,
        ),
    ] = None,
    name: Annotated[
        str | None,
        typer.Option(
            metavar="NAME", help="Call the monitor so, not like the file.", parser=ros_name
        ),
    ] = None,
    sources: ListOfSources = None,
    review: ReviewPage = None,
    system: Systems = None,
    messages: MessageFolders = None,
    only: Only = None,
) -> None:
    """Generate the monitor of a rules file."""
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
        GraphFormat, choice(GraphFormat, "How it is drawn.")
    ] = GraphFormat.TEXT,
    out: OptionalOutFile = None,
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """Draw the wiring of a rules file: what its node reads, filters and acts on."""
    from rossmarie.cli.graph import run_graph

    run_graph(rules, format, out, system or [], messages or [])


@app.command()
def export(
    rules: Rules,
    out: OutFile = Path("rules.json"),
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """Write for other programs what a rules file reads, asks and does."""
    from rossmarie.cli.export import run_export

    run_export(rules, out, system or [], messages or [])


@app.command()
def failures(
    rules: Rules,
    format: AnswerFormat = ReportFormat.TEXT,  # noqa: A002
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """Tell for each input which rules become active when it is stale."""
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
        typer.Option(metavar="YYYY-MM-DD", help="The day that the file bears; else today, in UTC."),
    ] = None,
    thorough: Annotated[
        bool, typer.Option("--thorough", help="Ask all queries about the rules, as `check`.")
    ] = False,
    system: Systems = None,
    messages: MessageFolders = None,
    only: Only = None,
) -> None:
    """Write the safety file of rules: hazards, rules in sentences, what is proved, what is not."""
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
    format: AnswerFormat = ReportFormat.TEXT,  # noqa: A002
    system: Systems = None,
    messages: MessageFolders = None,
    only: Only = None,
) -> None:
    """Run the monitor of a rules file over a recording, or over many at the same time."""
    chosen, pairs = list(dict.fromkeys(recordings)), topic_map or []
    rest = (pairs, out, format, system or [], messages or [], only or [])
    if len(chosen) == 1:
        from rossmarie.cli.replay import run_replay

        run_replay(rules, chosen[0], *rest)
    else:
        from rossmarie.cli.replays import run_replays

        run_replays(rules, chosen, *rest)


@app.command("test")
def run_tests(
    rules: Rules,
    tests: Annotated[
        list[str] | None,
        typer.Argument(metavar="TESTS...", help="Names of tests; `*` stands for anything."),
    ] = None,
    write: Annotated[
        bool,
        typer.Option("--write", help="First write tests of all boundaries beside the rules."),
    ] = False,
    junit: Annotated[
        Path | None,
        typer.Option("--junit", metavar="FILE", help="Also write JUnit's XML.", parser=written),
    ] = None,
    format: AnswerFormat = ReportFormat.TEXT,  # noqa: A002
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """Run the tests of a rules file on the interpreter and in C, and say what they cover."""
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
) -> None:
    """Say what recordings exercise of the rules, and how far each threshold could be moved."""
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
) -> None:
    """Prove that the generated C is what the rules mean, for runs of any length (CBMC)."""
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
