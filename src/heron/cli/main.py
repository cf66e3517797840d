"""The `heron` command: one function per subcommand.

Exit codes: 0 what was asked for was run, however it went, 1 an episode was not finished, 2 the
command itself was called wrongly or MuJoCo is not installed, 70 a defect of this tool, 128 plus the
number of a signal that ended it (130: Ctrl-C).
"""

from __future__ import annotations

import enum
import os
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from ctypes.util import find_library
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from dslkit.catalog import Catalog
from dslkit.command_line import CommandLine
from heron.variants import VARIANTS, Arm, Person, Table, Terrain

if TYPE_CHECKING:  # needs MuJoCo
    from campaign import Workers
    from heron.experiments import Observer


def _catalog() -> Catalog:
    from rossmarie.catalog import CATALOG

    return CATALOG


_LIMIT_S = 600.0  # of one episode
_PARTS = {"MuJoCo": "mujoco", "Matplotlib": "matplotlib", "Pillow": "PIL", "SciPy": "scipy"}
_VERSION = sys.version_info[:2]
_OLDEST = (3, 11)  # for which MuJoCo has wheels
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
View = Annotated[bool, typer.Option("--view", help="In a window, in real time.")]
Seed = Annotated[int, typer.Option("--seed", min=0, help="Of all that is left to chance.")]


@runs.command()
def nav(
    arm: Guarding = Arm.ROSSMARIE,
    terrain: Annotated[Terrain, typer.Option(help="What is in its way.")] = Terrain.GENTLE,
    seed: Seed = 0,
    view: View = False,
    ros1: Annotated[
        bool, typer.Option("--ros1", help="With the generated node on guard, by ROS_MASTER_URI.")
    ] = False,
) -> None:
    """Experiment I: through a corridor with a bump, up a ramp, to the block in the room."""
    if not ros1:
        _run("nav", arm, terrain, seed, is_viewed=view)
        return
    if arm is Arm.NONE:
        output.fail("--ros1 is about the node on guard, and --arm none has none", exit_code=2)
    _require_simulation()
    from heron.cli.live import run_live

    with _observers("nav", is_viewed=view) as observers:
        run_live(output, arm, terrain, seed, observers)


@runs.command()
def place(
    arm: Guarding = Arm.ROSSMARIE,
    table: Annotated[Table, typer.Option(help="Where it is, and in what haste.")] = Table.HIGH,
    seed: Seed = 0,
    view: View = False,
) -> None:
    """Experiment II: place a block on a table that is higher than the arm believes, or carry it
    there in too much haste.
    """
    _run("place", arm, table, seed, is_viewed=view)


@runs.command()
def human(
    arm: Guarding = Arm.ROSSMARIE,
    person: Annotated[Person, typer.Option(help="Where somebody walks.")] = Person.INSIDE,
    seed: Seed = 0,
    view: View = False,
) -> None:
    """Experiment III: carry a block to and fro while somebody comes into the room."""
    _run("human", arm, person, seed, is_viewed=view)


def _run(name: str, arm: Arm, variant: enum.Enum, seed: int, *, is_viewed: bool) -> None:
    _require_simulation()
    from heron.cli.episodes import print_episode
    from heron.experiments import EXPERIMENTS

    experiment = EXPERIMENTS[name]
    with _observers(name, is_viewed=is_viewed) as observers:
        print_episode(experiment, experiment.run(arm, variant, seed, observers))


@contextmanager
def _observers(name: str, *, is_viewed: bool) -> Iterator[list[Observer]]:
    """A window on an experiment for as long as it is needed, if one is wanted."""
    if not is_viewed:
        yield []
        return
    from heron.experiments import EXPERIMENTS
    from heron.viewing import Window, trouble

    reason = trouble()
    if reason is not None:
        output.fail(
            f"--view needs a display: {reason}; `heron demo` makes pictures without one",
            exit_code=2,
        )
    with Window(EXPERIMENTS[name].cameras) as window:
        yield [window]


@app.command()
def record(
    experiment: Annotated[str, typer.Argument(help="Which one: nav, place or human.")],
    out: Annotated[Path, typer.Option(help="The file, such as drive.mcap.")],
    arm: Guarding = Arm.ROSSMARIE,
    variant: Annotated[
        str | None, typer.Option(help="Which terrain, table or person; the first one if not given.")
    ] = None,
    seed: Seed = 0,
) -> None:
    """Run one episode, and write all its topics into an MCAP file."""
    chosen = _variant(_known(experiment), variant)
    if out.suffix != ".mcap":
        output.fail(f"the name of the recording has to end in .mcap, not as {out}", exit_code=2)
    if out.exists():
        output.fail(f"{out} is there already, and is not written over", exit_code=2)
    output.try_folder(out.parent)
    _require_simulation()
    from heron.cli.recording import record as record_episode

    record_episode(output, experiment, chosen, arm, seed, out)


@app.command()
def evaluate(
    seeds: Annotated[int, typer.Option(min=1, help="How many, from 0 on.")] = 30,
    experiment: Annotated[
        list[str] | None, typer.Option(help="Only this one; may be given several times.")
    ] = None,
    out: Annotated[
        Path, typer.Option(help="Folder of the page; what is done already is there, too.")
    ] = Path("build"),
    jobs: Annotated[
        int | None, typer.Option(min=1, help="Processes at a time; one for each core if not given.")
    ] = None,
    ray: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="Run on the Ray cluster at this host:port instead."),
    ] = None,
) -> None:
    """Run all arms of the experiments on many seeds, and write tables and plots.

    A run that was interrupted goes on where it was.
    """
    chosen = list(map(_known, dict.fromkeys(experiment or VARIANTS)))
    output.try_folder(out)
    _require_simulation()
    workers = _workers(jobs, ray)
    from heron.cli.evaluating import evaluate as run_all

    run_all(output, chosen, seeds, out, workers)


@app.command()
def demo(
    seed: Seed = 0,
    out: Annotated[Path, typer.Option(help="The page.")] = Path("build/heron.html"),
) -> None:
    """Episodes with and without the monitor, side by side on one page."""
    output.try_folder(out.parent)
    if out.parent.exists():
        output.try_file(out)
    _require_simulation()
    # MuJoCo looks at this when it is imported, and cannot be without what it names.
    os.environ.setdefault("MUJOCO_GL", "egl" if find_library("EGL") else "disable")
    from heron.cli.demonstrating import demonstrate

    demonstrate(output, seed, out)


def _workers(jobs: int | None, ray: str | None) -> Workers:
    from campaign import Processes

    if ray is None:
        return Processes(jobs or Processes.cores(), _LIMIT_S)
    if not re.fullmatch(r"\S+:\d+", ray):
        output.fail(f"--ray needs HOST:PORT, not `{ray}`", exit_code=2)
    if find_spec("ray") is None:
        output.fail("--ray needs the extra of that name: pip install 'rossmarie[ray]'", exit_code=2)
    from campaign.ray_cluster import RayCluster

    return RayCluster(ray)


def _known(experiment: str) -> str:
    """The name of an experiment that there is; known before the simulation is imported."""
    if experiment not in VARIANTS:
        there_are = ", ".join(VARIANTS)
        output.fail(f"there is no experiment {experiment}; there are {there_are}", exit_code=2)
    return experiment


def _variant(experiment: str, wanted: str | None) -> enum.Enum:
    """A variant by its name, else the first one."""
    variants = {variant.value: variant for variant in VARIANTS[experiment]}
    if wanted is None:
        return VARIANTS[experiment][0]
    if wanted not in variants:
        there_are = ", ".join(variants)
        output.fail(f"{experiment} has no variant {wanted}; there are {there_are}", exit_code=2)
    return variants[wanted]


def _require_simulation() -> None:
    """End the run with the reason if a part of the simulation is not installed."""
    missing = [name for name, module in _PARTS.items() if find_spec(module) is None]
    if not missing:
        return
    reason = f"the simulation needs {', '.join(missing)}, not installed for {sys.executable}"
    if "MuJoCo" in missing and _VERSION < _OLDEST:
        python, oldest = (".".join(map(str, each)) for each in (_VERSION, _OLDEST))
        reason = (
            f"the simulation needs MuJoCo, which needs Python {oldest} or later; "
            f"this is Python {python}"
        )
    output.fail(f"{reason}: pip install 'rossmarie[heron]'", exit_code=2)


def main() -> None:
    """The entry point."""
    output.run(app)
