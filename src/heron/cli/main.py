"""The `heron` command: one function per subcommand.

Exit codes: 0 the run finished, with any result; 1 an episode did not finish; 2 the arguments were
wrong or MuJoCo is not installed; 70 an internal error; 128 plus the number of a signal that ended
the run (130: Ctrl-C).
"""

from __future__ import annotations

import enum
from pathlib import Path
from typing import Annotated

import typer

from dslkit.options import Force
from dslkit.parameters import Group
from heron.cli.choices import (
    TRAINING_LIMIT_S,
    algorithms_of,
    budget_of,
    draw_without_display,
    known,
    learning_arms_of,
    output,
    require_arm,
    require_drawing,
    require_film,
    require_learning,
    require_place,
    require_simulation,
    require_trace,
    variant_of,
    workers_of,
)
from heron.cli.operating import insertion, policy
from heron.cli.options import (
    Algorithms,
    Begin,
    Experiment,
    Experiments,
    Filming,
    Guarding,
    Jobs,
    PageFile,
    Ray,
    RecordingFile,
    RunsFolder,
    Seed,
    TraceFile,
    Variant,
    View,
)
from heron.cli.watching import film_episode, observers
from heron.variants import (
    VARIANTS,
    Blockage,
    Encounter,
    ExperimentArm,
    Formulation,
    LearningArm,
    Passage,
    Person,
    Table,
    Terrain,
    Trouble,
)

_SHOWN_SEED = 1
"""The seed of the demo and the gallery. Its episodes end as most do; a test holds that."""
app = typer.Typer(
    help="Run the experiments of the thesis in a physics simulation.",
    cls=Group,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
    context_settings={"help_option_names": ["-h", "--help"]},
)
runs = typer.Typer(help="Run one episode of an experiment.", cls=Group, no_args_is_help=True)
app.add_typer(runs, name="run")


@app.callback()
def heron(version: Annotated[bool, output.version_option()] = False) -> None:
    """Run the experiments of the thesis in a physics simulation."""


@runs.command()
def nav(
    arm: Guarding = ExperimentArm.ROSSMARIE,
    variant: Annotated[Terrain, typer.Option(help="The terrain of the drive.")] = Terrain.GENTLE,
    seed: Seed = 0,
    view: View = False,
    film: Filming = None,
    ros1: Annotated[
        bool,
        typer.Option("--ros1", help="Use the generated node as the guard, through ROS_MASTER_URI."),
    ] = False,
    force: Force = False,
) -> None:
    """Experiment I: drive through a corridor with a bump, up a ramp, to the block in the room."""
    output.permit(force)
    if not ros1:
        _run("nav", arm, variant, seed, view, film)
        return
    if arm in (ExperimentArm.NONE, ExperimentArm.COLLISION_MONITOR):
        output.fail(
            f"--ros1 uses the generated node as the guard, but --arm {arm.value} has no such node",
            exit_code=2,
        )
    if film is not None:
        output.fail("--film needs an episode in this process: leave out --ros1", exit_code=2)
    require_simulation()
    from heron.cli.live import run_live

    with observers("nav", is_viewed=view) as watching:
        run_live(output, arm, variant, seed, watching)


@runs.command()
def place(
    arm: Guarding = ExperimentArm.ROSSMARIE,
    variant: Annotated[
        Table, typer.Option(help="The position of the table, and the speed of the arm.")
    ] = Table.HIGH,
    seed: Seed = 0,
    view: View = False,
    film: Filming = None,
    force: Force = False,
) -> None:
    """Experiment II: place a block on a table that is higher than expected, or move too fast."""
    output.permit(force)
    _run("place", arm, variant, seed, view, film)


@runs.command()
def human(
    arm: Guarding = ExperimentArm.ROSSMARIE,
    variant: Annotated[Person, typer.Option(help="The path of the person.")] = Person.INSIDE,
    seed: Seed = 0,
    view: View = False,
    film: Filming = None,
    force: Force = False,
) -> None:
    """Experiment III: carry a block back and forth while a person enters the room."""
    output.permit(force)
    _run("human", arm, variant, seed, view, film)


@runs.command()
def contact(
    arm: Guarding = ExperimentArm.SKILL_AWARE,
    variant: Annotated[
        Encounter,
        typer.Option(help="The unexpected contact of the arm."),
    ] = Encounter.COLLISION,
    seed: Seed = 0,
    view: View = False,
    film: Filming = None,
    force: Force = False,
) -> None:
    """Experiment IV: push a box to a mark and wipe a board, while a person reaches over the table
    or the box jams.
    """
    output.permit(force)
    _run("contact", arm, variant, seed, view, film)


@runs.command()
def corridor(
    arm: Guarding = ExperimentArm.PROACTIVE,
    variant: Annotated[Passage, typer.Option(help="The people in the corridor.")] = Passage.CHILD,
    seed: Seed = 0,
    view: View = False,
    film: Filming = None,
    force: Force = False,
) -> None:
    """Experiment V: drive along a corridor past a school while a child runs out of a door."""
    output.permit(force)
    _run("corridor", arm, variant, seed, view, film)


@runs.command()
def blocked(
    arm: Guarding = ExperimentArm.TREES,
    variant: Annotated[Blockage, typer.Option(help="The obstacle on the path.")] = Blockage.PALLET,
    seed: Seed = 0,
    view: View = False,
    film: Filming = None,
    force: Force = False,
) -> None:
    """Experiment VI: drive to a hall while an obstacle blocks the shortest path."""
    output.permit(force)
    _run("blocked", arm, variant, seed, view, film)


@runs.command()
def second(
    arm: Guarding = ExperimentArm.LEARNED,
    variant: Annotated[
        Trouble, typer.Option(help="The obstacle on the path in most runs.")
    ] = Trouble.LASTING,
    seed: Seed = 0,
    view: View = False,
    film: Filming = None,
    force: Force = False,
) -> None:
    """Experiment VII: drive to a hall with a planner that uses knowledge from earlier runs."""
    output.permit(force)
    _run("second", arm, variant, seed, view, film)


runs.command()(insertion)


def _run(
    name: str,
    arm: ExperimentArm,
    variant: enum.Enum,
    seed: int,
    is_viewed: bool,
    film: Path | None,
) -> None:
    require_arm(name, arm)
    if film is not None:
        film_episode(name, arm, variant, seed, film, is_viewed=is_viewed)
        return
    require_simulation()
    from heron.cli.episodes import print_episode
    from heron.experiments import EXPERIMENTS, USUAL

    experiment = EXPERIMENTS[name]
    with observers(name, is_viewed=is_viewed) as watching:
        print_episode(experiment, experiment.run(arm, variant, seed, watching, USUAL))


@app.command()
def record(
    experiment: Experiment,
    out: RecordingFile,
    arm: Guarding = ExperimentArm.ROSSMARIE,
    variant: Variant = None,
    seed: Seed = 0,
    trace: TraceFile = None,
    begin: Begin = 0,
    force: Force = False,
) -> None:
    """Run one episode, and record all its topics in an MCAP file."""
    output.permit(force)
    chosen = variant_of(known(experiment), variant)
    require_arm(experiment, arm)
    if out.suffix != ".mcap":
        output.fail(f"the name of the recording must end in .mcap, unlike {out}", exit_code=2)
    require_place(out)
    if trace is not None:
        require_trace(trace)
    require_simulation()
    from heron.cli.recording import Files
    from heron.cli.recording import record as record_episode

    files = Files(out, trace, begin * 1_000_000_000)
    record_episode(output, experiment, chosen, arm, seed, files)


@app.command()
def evaluate(
    seeds: Annotated[int, typer.Option(min=1, help="The number of seeds, starting at 0.")] = 30,
    experiment: Experiments = None,
    out: RunsFolder = Path("build"),
    jobs: Jobs = None,
    ray: Ray = None,
    force: Force = False,
) -> None:
    """Run all arms of the experiments on many seeds, and write tables and plots.

    An interrupted run continues with the missing episodes.
    """
    output.permit(force)
    chosen = list(map(known, dict.fromkeys(experiment or VARIANTS)))
    output.try_folder(out)
    require_simulation()
    workers = workers_of(jobs, ray)
    from heron.cli.evaluating import evaluate as run_all

    run_all(output, chosen, seeds, out, workers)


@app.command()
def learn(
    formulation: Annotated[
        Formulation,
        typer.Argument(help="The learned quantity: velocities, moves, or the numbers of a tree."),
    ],
    algorithm: Algorithms = None,
    arm: Annotated[
        list[LearningArm] | None,
        typer.Option(help="An experiment arm; repeat the option for several. Default: all."),
    ] = None,
    seeds: Annotated[int, typer.Option(min=1, help="The number of seeds, starting at 0.")] = 1,
    steps: Annotated[
        int | None,
        typer.Option(min=1, help="The steps of a training; default: see docs/learning.md."),
    ] = None,
    out: RunsFolder = Path("build"),
    film: Filming = None,
    jobs: Jobs = None,
    ray: Ray = None,
    force: Force = False,
) -> None:
    """Train the insertion of figure 4 with and without rules, on many seeds.

    An interrupted run continues with the missing trainings.
    """
    output.permit(force)
    algorithms = algorithms_of(formulation, algorithm)
    arms = learning_arms_of(formulation, arm)
    budget = budget_of(formulation, steps)
    output.try_folder(out)
    if film is not None:
        require_film(film)
        require_drawing()
    require_simulation()
    require_learning(algorithms)
    workers = workers_of(jobs, ray, TRAINING_LIMIT_S)
    from heron.cli.learning import learn as run_all
    from heron.learning.runs import runs_of

    runs = list(runs_of(formulation, algorithms, arms, budget, seeds))
    run_all(output, runs, out, workers, film)


app.command()(policy)


@app.command()
def demo(
    seed: Seed = _SHOWN_SEED,
    out: PageFile = Path("build/heron.html"),
    force: Force = False,
) -> None:
    """Write a page with one episode of each experiment, for all guards side by side."""
    output.permit(force)
    require_place(out)
    draw_without_display()
    require_simulation()
    from heron.cli.demonstrating import demonstrate

    demonstrate(output, seed, out)


@app.command()
def gallery(
    seed: Seed = _SHOWN_SEED,
    out: Annotated[
        Path,
        typer.Option(
            "--out", "-o", metavar="DIR", help="The output folder of the page and its films."
        ),
    ] = Path("build"),
    force: Force = False,
) -> None:
    """Write a page with films of the experiments, with and without a monitor."""
    output.permit(force)
    output.try_folder(out)
    require_drawing()
    require_simulation()
    from heron.cli.filming import show_gallery

    show_gallery(output, seed, out)


def main() -> None:
    """The entry point."""
    output.run(app)
