"""`heron run insertion` and `heron policy`: learned policies in operation."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

import typer
from rich.console import Console
from rich.table import Table

from dslkit.command_line import CommandLine
from dslkit.writing import reason
from heron.cli.filming import write_film
from heron.cli.live import node_of
from heron.films.insertion import film_of_insertion
from heron.learning.arms import ARM_NAMES
from heron.learning.insertion import InsertionOutcome
from heron.learning.learned import Learned, read_learned
from heron.operation import LiveArm, LivePolicy
from heron.ros1 import Ros1Error
from heron.variants import LearningArm


def insert(
    output: CommandLine, policy: Path, arm: LearningArm, seed: int, film: Path | None
) -> None:
    """Run an episode of a learned policy, print its outcome, and write its film."""
    found = _read(output, policy)
    clip = film_of_insertion(found.begin(), arm, seed, found.formulation)
    _print_outcome(clip.outcome, f"{ARM_NAMES[arm]}, seed {seed}")
    if film is not None:
        write_film(output, [clip], film)


def insert_live(output: CommandLine, seed: int) -> None:
    """Run an episode of an arm that ROS 1 commands, and print its outcome."""
    try:
        with closing(node_of("/heron_arm")) as node:
            outcome = LiveArm(node, seed).run()
    except Ros1Error as error:
        output.fail(str(error), exit_code=1)
    _print_outcome(outcome, f"commanded by ROS 1, seed {seed}")


def command(output: CommandLine, policy: Path) -> None:
    """Command an arm by ROS 1, for one episode."""
    found = _read(output, policy)
    try:
        with closing(node_of("/heron_policy")) as node:
            seconds = LivePolicy(node, found.begin()).run()
    except Ros1Error as error:
        output.fail(str(error), exit_code=1)
    typer.echo(f"the policy commanded the arm for {seconds:.1f} s")


def _read(output: CommandLine, policy: Path) -> Learned:
    try:
        return read_learned(policy)
    except OSError as error:
        output.fail(f"cannot read {policy}: {reason(error)}", exit_code=2)
    except ValueError as error:
        output.fail(str(error), exit_code=2)


def _print_outcome(outcome: InsertionOutcome, title: str) -> None:
    done = "inserted" if outcome.inserted else "not inserted"
    table = Table("measure", "value", title=title, title_justify="left")
    table.columns[1].justify = "right"
    table.add_row("task", done)
    table.add_row("time", f"{outcome.seconds:.1f} s")
    table.add_row("force on the fragile part", f"{outcome.greatest_touch:.0f} N")
    table.add_row("force at the wrist", f"{outcome.greatest_force:.0f} N")
    table.add_row("speed near the person", f"{outcome.fastest_near_person:.2f} m/s")
    table.add_row("violations", ", ".join(outcome.violations) or "none")
    Console(highlight=False).print(table)
