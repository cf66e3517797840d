"""The `ezskiros` command: one function per subcommand.

Exit codes: 0 for no errors (there may be warnings), 1 for errors, 2 for wrong arguments or an
unreadable file, 70 for an internal error.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from dslkit.completion import codes
from dslkit.options import Force, Format, ReportFormat, StudyFile
from dslkit.parameters import Group
from dslkit.writing import reason
from ezskiros.cli.arguments import Folders, Knowledge, Skills, name_ontology, of_rules, of_skills
from ezskiros.cli.checking import asked, print_check
from ezskiros.cli.example import example
from ezskiros.cli.export import export
from ezskiros.cli.learn import learn
from ezskiros.cli.output import output
from ezskiros.cli.owl import owl
from ezskiros.cli.plan import plan
from ezskiros.cli.run import run
from ezskiros.cli.show import show

if TYPE_CHECKING:  # libcst is loaded only when needed
    from ezskiros.migrate.files import MigratedFile

app = typer.Typer(
    help="Check skills for SkiROS2 against the ontology before the robot starts.",
    cls=Group,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.command()(run)
Paths = Annotated[
    list[Path],
    typer.Argument(
        metavar="PATHS...",
        help="Python files, or folders with Python files.",
        callback=of_skills,
        readable=False,
    ),
]


@app.callback()
def ezskiros(version: Annotated[bool, output.version_option()] = False) -> None:
    """Check skills for SkiROS2 against the ontology before the robot starts."""


@app.command()
def check(
    paths: Skills,
    ontology: Folders = None,
    values: Annotated[
        Path | None,
        typer.Option(
            "--config", metavar="FILE", help="Parameter values that are known at launch (YAML)."
        ),
    ] = None,
    form: Annotated[
        Format, typer.Option("--format", help="The format of the findings.")
    ] = Format.TEXT,
    watched: Annotated[
        bool, typer.Option("--watch", help="Check again whenever a file changes.")
    ] = False,
    rules: Annotated[
        Path | None,
        typer.Option(
            "--rules",
            metavar="FILE",
            help="Also check these rules together with the skills.",
            callback=of_rules,
        ),
    ] = None,
    knowledge: Knowledge = None,
    fixed: Annotated[
        bool, typer.Option("--fix", help="First add missing pre-conditions to compound skills.")
    ] = False,
    study: StudyFile = None,
) -> None:
    """Check the skills in Python files, and report all errors. ROS is not needed."""
    name_ontology(ontology)
    if watched:
        if fixed:
            output.fail("give `--fix` or `--watch`, not both", exit_code=2)
        output.try_study(study)
        _check_again_and_again(paths, ontology or [], values, form, rules, knowledge, study)
        return
    with output.answering(form, "check", files=len(paths)):
        output.try_study(study)
        if fixed:
            from ezskiros.cli.fix import fix

            fix(paths)
        raise typer.Exit(print_check(paths, values, form, rules, knowledge, study))


@app.command()
def explain(
    what: Annotated[
        str,
        typer.Argument(
            metavar="CODE|SKILL",
            help="A code such as EZS401, or a skill such as Pick.",
            autocompletion=codes("ezskiros"),
        ),
    ],
    paths: Annotated[
        list[Path] | None,
        typer.Argument(metavar="PATHS...", help="The files or folders with the skill."),
    ] = None,
    ontology: Folders = None,
) -> None:
    """Explain a diagnostic, or how the inferred parameters of a skill get their values."""
    if not paths:
        hint = f"; for a skill name its files, too: `ezskiros explain {what} PATHS...`"
        output.explain(what, hint if what.isidentifier() else "")
        return
    from ezskiros.driver import explain_skill

    name_ontology(ontology)
    text, _ = asked(lambda collector: explain_skill(what, paths, collector))
    typer.echo(text)


app.command()(show)
app.command()(plan)
app.command()(owl)
app.command()(export)
app.command()(learn)
app.command()(example)


@app.command()
def migrate(
    paths: Paths,
    write: Annotated[bool, typer.Option("--write", help="Change the files in place.")] = False,
    diff: Annotated[bool, typer.Option("--diff", help="Print the changes instead.")] = False,
    form: Annotated[
        ReportFormat, typer.Option("--format", help="The format of findings and result.")
    ] = ReportFormat.TEXT,
    world: Annotated[
        str, typer.Option(metavar="MODULE", help="The module that loads the ontology.")
    ] = "world",
    ontology: Annotated[
        list[Path] | None,
        typer.Option(
            "--ontology",
            metavar="PATH",
            help="Ontology files and folders; used to find ambiguous names.",
            exists=True,
        ),
    ] = None,
) -> None:
    """Translate skills of SkiROS2: descriptions, behavior trees and primitives."""
    with output.answering(form, "migrate", files=len(paths)) as answer:
        from ezskiros.migrate.files import migrate_paths
        from ezskiros.migrate.imports import is_module

        if write and diff:
            output.fail("give `--write` or `--diff`, not both", exit_code=2)
        if not is_module(world):
            output.fail(
                f"`{world}` is not the name of a Python module, such as `.world`", exit_code=2
            )
        found = migrate_paths(paths, world, _ambiguous(ontology))
        if write:
            _write([file for file in found.files if file.is_changed])
        if answer.is_printed:
            output.print_findings(found.diagnostics)
            answer.result = found.result(is_written=write)
        elif diff:
            for file in found.files:
                typer.echo(file.diff(), nl=False)
            typer.echo(found.summary(is_written=False), err=True)
        else:
            output.print_findings(found.diagnostics)
            typer.echo(found.summary(is_written=write))
        raise typer.Exit(output.exit_code(found.diagnostics))


def _ambiguous(ontology: list[Path] | None) -> frozenset[str]:
    """The names that are in several namespaces of an ontology. The run ends if the ontology cannot
    be read.

    Warnings about the ontology are left to `check`.
    """
    if not ontology:
        return frozenset()
    from ezskiros.driver import ambiguous_names

    name_ontology(ontology)
    names, found = ambiguous_names()
    if output.exit_code(found):
        output.reject(found)
    return names


def _write(files: Sequence[MigratedFile]) -> None:
    """Write the migrated files. The run ends if this fails."""
    for file in files:
        output.try_change(file.path)
    for file in files:
        with output.writing(file.path):
            file.write()


@app.command()
def stubs(
    out: Annotated[
        Path,
        typer.Option(
            "--out",
            "-o",
            metavar="FILE",
            help="The stub file, next to the module that loads the ontology.",
        ),
    ],
    ontology: Folders = None,
    is_check: Annotated[
        bool, typer.Option("--check", help="Write no file; exit with 1 if the stub is stale.")
    ] = False,
    relations: Annotated[
        bool,
        typer.Option(help="Include the built-in relations of SkiROS2, like `load`."),
    ] = True,
    force: Force = False,
) -> None:
    """Write a stub (`.pyi`) of the ontology for editors and type checkers."""
    output.permit(force)
    if not is_check:
        output.try_file(out)
    from ezskiros.driver import stub_of

    name_ontology(ontology)
    text, found = stub_of(relations=relations)
    if output.exit_code(found):
        output.reject(found)
    output.print_findings(found)
    if not is_check:
        output.save(out, text)
    elif _is_stale(out, text):
        output.fail(f"{out} is stale: run this command again, without --check", exit_code=1)


def _is_stale(stub: Path, text: str) -> bool:
    """Say whether a stub differs from a text. The run ends if the stub cannot be read."""
    try:
        return not stub.exists() or stub.read_bytes().replace(b"\r", b"") != text.encode()
    except OSError as problem:
        output.fail(f"cannot read {stub}: {reason(problem)}", exit_code=2)


def _check_again_and_again(
    paths: list[Path],
    ontology: list[Path],
    values: Path | None,
    form: Format,
    rules: Path | None,
    knowledge: Path | None,
    study: Path | None,
) -> None:
    """Repeat the check in a new process after each change, so that no imported module stays."""
    from ezskiros.cli.watch import watch
    from ezskiros.ontology.read import find
    from ezskiros.skills.load import module_files

    def files() -> list[Path]:
        known = [path for path in ontology if path.exists()]
        named = [*paths, *(each for each in (values, rules, knowledge) if each)]
        return [*module_files(paths), *filter(Path.is_file, named), *find(known)]

    def check_once() -> None:
        print_check(paths, values, form, rules, knowledge, study)
        sys.stdout.flush()

    watch(files, check_once)


def main() -> None:
    """Run the command line."""
    output.run(app)
