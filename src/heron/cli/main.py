"""The `heron` command: one function per subcommand.

Exit codes: 0 the episode was run, however it went, 2 the command itself was called wrongly or
MuJoCo is not installed, 70 a defect of this tool.
"""

from __future__ import annotations

from importlib.util import find_spec
from typing import Annotated

import typer

from dslkit.catalog import Catalog
from dslkit.command_line import CommandLine
from heron.variants import Arm, Person, Table, Terrain


def _catalog() -> Catalog:
    from rossmarie.catalog import CATALOG

    return CATALOG


output = CommandLine(
    tool="heron",
    subject="what you called it with",
    internal_code="HERON",
    unreadable=frozenset(),
    catalog=_catalog,
)
app = typer.Typer(
    help="The experiments of the thesis, in physics.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
    context_settings={"help_option_names": ["-h", "--help"]},
)
runs = typer.Typer(help="Run one episode of an experiment.", no_args_is_help=True)
app.add_typer(runs, name="run")


@app.callback()
def heron(version: Annotated[bool, output.version_option()] = False) -> None:
    """The experiments of the thesis, in physics."""


Guarding = Annotated[Arm, typer.Option("--arm", help="What guards the robot.")]
Seed = Annotated[int, typer.Option("--seed", min=0, help="Of all that is left to chance.")]


@runs.command()
def nav(
    arm: Guarding = Arm.ROSSMARIE,
    terrain: Annotated[Terrain, typer.Option(help="What is in its way.")] = Terrain.GENTLE,
    seed: Seed = 0,
) -> None:
    """Experiment I: through a corridor with a bump, up a ramp, to the block in the room."""
    _require_simulation()
    from heron.cli.episodes import print_navigation
    from heron.experiments import run_navigation

    print_navigation(run_navigation(arm, terrain, seed))


@runs.command()
def place(
    arm: Guarding = Arm.ROSSMARIE,
    table: Annotated[Table, typer.Option(help="Where it is, and in what haste.")] = Table.HIGH,
    seed: Seed = 0,
) -> None:
    """Experiment II: place a block on a table that is higher than the arm believes, or carry it
    there in too much haste.
    """
    _require_simulation()
    from heron.cli.episodes import print_placing
    from heron.experiments import run_placing

    print_placing(run_placing(arm, table, seed))


@runs.command()
def human(
    arm: Guarding = Arm.ROSSMARIE,
    person: Annotated[Person, typer.Option(help="Where somebody walks.")] = Person.INSIDE,
    seed: Seed = 0,
) -> None:
    """Experiment III: carry a block to and fro while somebody comes into the room."""
    _require_simulation()
    from heron.cli.episodes import print_human
    from heron.experiments import run_human

    print_human(run_human(arm, person, seed))


def _require_simulation() -> None:
    if find_spec("mujoco") is None:
        output.fail(
            "the simulation needs MuJoCo, which needs Python 3.11 or later: "
            "pip install 'rossmarie[heron]'",
            exit_code=2,
        )


def main() -> None:
    """The entry point."""
    output.run(app)
