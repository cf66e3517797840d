"""The `rossmarie` command: one function per subcommand.

Exit codes: 0 all is well (warnings may have been printed), 1 something was found or could not be
done, 2 the command itself was called wrongly or a file could not be read, 70 a defect of this tool.
Imports that only one subcommand needs are made in it, so that every other one starts fast.
"""

from __future__ import annotations

import enum
from pathlib import Path
from typing import Annotated, Any

import typer

from dslkit.command_line import Format
from rossmarie.cli.output import each_once, output

app = typer.Typer(
    help="Safety rules for robots: check them, build their monitor, replay a recording.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _written(text: str) -> Path:
    """A path to write to; an empty one would be the folder that one happens to be in."""
    if not text:
        raise typer.BadParameter("the path is empty")
    return Path(text)


def _choice(kind: type[enum.Enum], text: str) -> Any:
    """An option that takes one of the values of `kind`, in upper or lower case."""
    values = [str(member.value) for member in kind]

    def parse(word: str) -> enum.Enum:
        if isinstance(word, kind):
            return word  # the default
        if word.lower() not in values:
            raise typer.BadParameter(f"`{word}` is none of {', '.join(values)}")
        return kind(word.lower())

    return typer.Option(help=text, parser=parse, metavar="|".join(values))


# Not `readable`: a file that cannot be read is a finding like others (ROSS801, ROSS611).
Rules = Annotated[Path, typer.Argument(metavar="RULES", help="A .ross file.", readable=False)]
RulesFiles = Annotated[
    list[Path], typer.Argument(metavar="RULES...", help=".ross files.", readable=False)
]
Systems = Annotated[
    list[Path] | None,
    typer.Option(
        "--system", metavar="FILE", help="A system model beside those imported.", readable=False
    ),
]
MessageFolders = Annotated[
    list[Path] | None,
    typer.Option(
        "--messages", metavar="DIR", help="A folder with .msg files.", exists=True, file_okay=False
    ),
]


@app.callback()
def rossmarie(version: Annotated[bool, output.version_option()] = False) -> None:
    """Safety rules for robots: check them, build their monitor, replay a recording."""


class TargetName(str, enum.Enum):
    """What `build` can generate."""

    C99 = "c99"
    PYTHON = "python"
    ROS1 = "ros1"
    ROS2 = "ros2"


class StageName(str, enum.Enum):
    """Where `dump` stops."""

    PARSE = "parse"
    CHECK = "check"
    LOWER = "lower"
    GENERATE = "generate"


class GraphFormat(str, enum.Enum):
    """How `graph` draws."""

    TEXT = "text"
    SVG = "svg"
    DOT = "dot"


class DumpFormat(str, enum.Enum):
    """How `dump` writes."""

    TEXT = "text"
    JSON = "json"


@app.command()
def check(
    files: RulesFiles,
    format: Annotated[  # noqa: A002
        Format, _choice(Format, "How findings are printed.")
    ] = Format.TEXT,
    target: Annotated[
        TargetName | None, _choice(TargetName, "Also report what this target cannot do.")
    ] = None,
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """Check rules files: names, types, units, and what cannot work."""
    folders, systems = messages or (), system or ()
    if target is None:
        from rossmarie.driver import check_file

        results = [check_file(path, systems=systems, message_folders=folders) for path in files]
        findings = [result.diagnostics for result in results]
    else:
        from rossmarie.driver.build import check_for

        findings = [
            check_for(target.value, path, systems=systems, message_folders=folders)
            for path in files
        ]
    found = each_once(finding for those in findings for finding in those)
    output.print_diagnostics(found, format, file_count=len(files))
    raise typer.Exit(output.exit_code(found))


@app.command()
def explain(
    code: Annotated[str, typer.Argument(metavar="CODE", help="Such as ROSS301.")],
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
    from rossmarie.driver.formatting import Formatted, format_file
    from rossmarie.driver.writing import reason, write_whole

    exit_code = 0
    for path in files:
        result = format_file(path)
        if not isinstance(result, Formatted):
            output.print_diagnostics(result, Format.TEXT, file_count=1)
            exit_code = max(exit_code, output.exit_code(result))
        elif result.has_changed and check_only:
            typer.echo(f"would reformat {path}")
            exit_code = max(exit_code, 1)
        elif result.has_changed:
            try:
                write_whole(path, result.text)
            except OSError as error:
                output.complain(f"cannot write {path}: {reason(error)}")
                exit_code = 2
            else:
                typer.echo(f"reformatted {path}")
    raise typer.Exit(exit_code)


@app.command()
def dump(
    rules: Rules,
    after: Annotated[StageName, _choice(StageName, "The stage to stop after.")] = StageName.LOWER,
    format: Annotated[  # noqa: A002
        DumpFormat, _choice(DumpFormat, "How it is written.")
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
        Path, typer.Option("--out", "-o", metavar="DIR", help="Where to write.", parser=_written)
    ],
    target: Annotated[TargetName, _choice(TargetName, "What to generate.")] = TargetName.C99,
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """Generate the monitor of a rules file."""
    from rossmarie.driver import RulesError
    from rossmarie.driver.build import ForeignFileError, build_files
    from rossmarie.driver.writing import reason

    try:
        built = build_files(
            rules, target.value, out, systems=system or (), message_folders=messages or ()
        )
    except RulesError as error:
        output.reject(error.diagnostics)
    except ForeignFileError as error:
        output.fail(f"{error}; remove it, or choose another --out", exit_code=2)
    except OSError as error:
        output.fail(f"cannot write to {out}: {reason(error)}", exit_code=2)
    output.print_diagnostics(built.warnings, Format.TEXT, file_count=1)
    for path in built.written:
        typer.echo(f"wrote {path}")
    if built.next_step:
        typer.echo(built.next_step)


@app.command()
def graph(
    rules: Rules,
    format: Annotated[  # noqa: A002
        GraphFormat, _choice(GraphFormat, "How it is drawn.")
    ] = GraphFormat.TEXT,
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", metavar="FILE", help="Write this file.", parser=_written),
    ] = None,
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """Draw the wiring of a rules file: what its node reads, filters and acts on."""
    from rossmarie.cli.graph import run_graph

    run_graph(rules, format.value, out, system or [], messages or [])


@app.command()
def replay(
    rules: Rules,
    recording: Annotated[
        Path,
        typer.Argument(
            metavar="RECORDING", help=".bag, .db3, .mcap, a bag folder, or .csv.", readable=False
        ),
    ],
    topic_map: Annotated[
        list[str] | None,
        typer.Option(
            "--topic-map",
            metavar="RULES=RECORDED",
            help="Read the topic that the rules call RULES from the recorded topic RECORDED.",
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            "-o",
            metavar="DIR",
            help="Write timeline.html and verdicts.jsonl here.",
            parser=_written,
        ),
    ] = None,
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """Run the monitor of a rules file over a recording."""
    from rossmarie.cli.replay import run_replay

    run_replay(rules, recording, topic_map or [], out, system or [], messages or [])


@app.command()
def model(
    recording: Annotated[
        Path, typer.Argument(metavar="RECORDING", help="Any recording.", readable=False)
    ],
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", metavar="FILE", help="Write this file.", parser=_written),
    ] = None,
) -> None:
    """Write the system model of a recording: its topics and their types."""
    from rossmarie.cli.replay import write_model_of

    write_model_of(recording, out)


def main() -> None:
    """Run the command line."""
    output.run(app)
