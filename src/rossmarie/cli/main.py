"""The `rossmarie` command: one function per subcommand.

Exit codes: 0 all is well (warnings may have been printed), 1 something was found or could not be
done, 2 the command itself was called wrongly or a file could not be read, 70 a defect of this tool.
Imports that only one subcommand needs are made in it, so that every other one starts fast.
"""

from __future__ import annotations

import enum
import sys
import traceback
from pathlib import Path
from typing import Annotated

import typer

from rossmarie.cli import output
from rossmarie.cli.output import Format

app = typer.Typer(
    help="Safety rules for robots: check them, build their monitor, replay a recording.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
)

Rules = Annotated[Path, typer.Argument(metavar="RULES", help="A .ross file.")]
Systems = Annotated[
    list[Path] | None,
    typer.Option("--system", metavar="FILE", help="A system model beside those imported."),
]
MessageFolders = Annotated[
    list[Path] | None,
    typer.Option(
        "--messages", metavar="DIR", help="A folder with .msg files.", exists=True, file_okay=False
    ),
]


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"rossmarie {output.own_version()}")
        raise typer.Exit


@app.callback()
def rossmarie(
    version: Annotated[
        bool,
        typer.Option(
            "--version", help="Print the version.", is_eager=True, callback=_print_version
        ),
    ] = False,
) -> None:
    """Safety rules for robots: check them, build their monitor, replay a recording."""


class TargetName(str, enum.Enum):
    """What `build` can generate."""

    C99 = "c99"


class StageName(str, enum.Enum):
    """Where `dump` stops."""

    PARSE = "parse"
    CHECK = "check"
    LOWER = "lower"
    GENERATE = "generate"


@app.command()
def check(
    files: Annotated[list[Path], typer.Argument(metavar="RULES...", help=".ross files.")],
    format: Annotated[Format, typer.Option(help="How findings are printed.")] = Format.TEXT,  # noqa: A002
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """Check rules files: names, types, units, and what cannot work."""
    from rossmarie.driver import check_file

    results = [
        check_file(path, systems=system or (), message_folders=messages or ()) for path in files
    ]
    found = output.each_once(finding for result in results for finding in result.diagnostics)
    output.print_diagnostics(found, format, file_count=len(files))
    raise typer.Exit(output.exit_code(found))


@app.command()
def explain(
    code: Annotated[str, typer.Argument(metavar="CODE", help="Such as ROSS301.")],
) -> None:
    """Explain a diagnostic: what it means, an example, what to write instead."""
    from rossmarie.catalog import UnknownCodeError, page

    try:
        text = page(code)
    except UnknownCodeError as error:
        output.fail(str(error), exit_code=2)
    output.print_page(text)


@app.command()
def fmt(
    files: Annotated[list[Path], typer.Argument(metavar="RULES...", help=".ross files.")],
    check_only: Annotated[
        bool, typer.Option("--check", help="Change nothing; exit with 1 if something would.")
    ] = False,
) -> None:
    """Write rules files in the one layout."""
    from rossmarie.driver.formatting import Formatted, format_file

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
            path.write_text(result.text, encoding="utf-8", newline="")
            typer.echo(f"reformatted {path}")
    raise typer.Exit(exit_code)


@app.command()
def dump(
    rules: Rules,
    after: Annotated[StageName, typer.Option(help="The stage to stop after.")] = StageName.LOWER,
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """Show what the compiler holds after a stage."""
    from rossmarie.driver import RulesError
    from rossmarie.driver.dump import Stage
    from rossmarie.driver.dump import dump as dump_stage

    try:
        text = dump_stage(
            rules, Stage(after.value), systems=system or (), message_folders=messages or ()
        )
    except RulesError as error:
        output.reject(error.diagnostics)
    typer.echo(text, nl=False)


@app.command()
def build(
    rules: Rules,
    out: Annotated[Path, typer.Option("--out", "-o", metavar="DIR", help="Where to write.")],
    target: Annotated[TargetName, typer.Option(help="What to generate.")] = TargetName.C99,
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """Generate the monitor of a rules file."""
    from rossmarie.driver import RulesError
    from rossmarie.driver.build import build_files

    try:
        written, found = build_files(
            rules, target.value, out, systems=system or (), message_folders=messages or ()
        )
    except RulesError as error:
        output.reject(error.diagnostics)
    except OSError as error:
        output.fail(f"cannot write to {out}: {error.strerror}", exit_code=2)
    output.print_diagnostics(found, Format.TEXT, file_count=1)
    for path in written:
        typer.echo(f"wrote {path}")


@app.command()
def replay(
    rules: Rules,
    recording: Annotated[
        Path, typer.Argument(metavar="RECORDING", help=".bag, .db3, .mcap, a bag folder, or .csv.")
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
        typer.Option("--out", metavar="DIR", help="Write timeline.html and verdicts.jsonl here."),
    ] = None,
    system: Systems = None,
    messages: MessageFolders = None,
) -> None:
    """Run the monitor of a rules file over a recording."""
    from rossmarie.cli.replay import run_replay

    run_replay(rules, recording, topic_map or [], out, system or [], messages or [])


@app.command()
def model(
    recording: Annotated[Path, typer.Argument(metavar="RECORDING", help="Any recording.")],
    out: Annotated[
        Path | None, typer.Option("--out", "-o", metavar="FILE", help="Write here.")
    ] = None,
) -> None:
    """Write the system model of a recording: its topics and their types."""
    from rossmarie.cli.replay import write_model_of

    write_model_of(recording, out)


def main() -> None:
    """Run the command line; a defect of ours is reported as one."""
    try:
        app()
    except Exception:
        detail = traceback.format_exc()
        output.internal_error(detail)
        sys.exit(output.INTERNAL_ERROR)
