"""The commands of the insertion in operation."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from dslkit.options import Force
from heron.cli.choices import (
    output,
    require_drawing,
    require_film,
    require_gymnasium,
    require_simulation,
)
from heron.cli.options import Filming, Seed
from heron.variants import LearningArm


def insertion(
    policy: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="policy.npz or numbers.json of `heron learn`."),
    ] = None,
    arm: Annotated[
        LearningArm, typer.Option(help="guard or unguarded; the other arms are for training.")
    ] = LearningArm.GUARD,
    seed: Seed = 0,
    film: Filming = None,
    ros1: Annotated[
        bool,
        typer.Option("--ros1", help="Run only the arm, in real time, through ROS_MASTER_URI."),
    ] = False,
    force: Force = False,
) -> None:
    """Figure 4: insert a peg next to a fragile part and a person, with a learned policy."""
    output.permit(force)
    if arm not in (LearningArm.GUARD, LearningArm.UNGUARDED):
        output.fail(f"insertion has no arm {arm.value}; there are unguarded, guard", exit_code=2)
    if ros1:
        _insert_live(policy, arm, seed, film)
        return
    if policy is None:
        output.fail("an episode needs --policy FILE: `heron learn` writes such files", exit_code=2)
    if film is not None:
        require_film(film)
        require_drawing()
    require_simulation()
    require_gymnasium()
    from heron.cli.inserting import insert

    insert(output, policy, arm, seed, film)


def _insert_live(policy: Path | None, arm: LearningArm, seed: int, film: Path | None) -> None:
    if policy is not None:
        output.fail(
            "--ros1 runs only the arm, and the policy is a separate node: leave out --policy, and "
            f"run `heron policy {policy}`",
            exit_code=2,
        )
    if arm is LearningArm.UNGUARDED:
        output.fail(
            f"--ros1 uses the generated node as the guard, but --arm {arm.value} has no such node",
            exit_code=2,
        )
    if film is not None:
        output.fail("--film needs an episode in this process: leave out --ros1", exit_code=2)
    require_simulation()
    require_gymnasium()
    from heron.cli.inserting import insert_live

    insert_live(output, seed)


def policy(
    learned: Annotated[
        Path,
        typer.Argument(metavar="FILE", help="policy.npz or numbers.json of `heron learn`."),
    ],
) -> None:
    """Command the arm of the insertion through ROS 1 with a learned policy, for one episode.

    This node publishes to the guard node, which is generated from the same rules.
    """
    require_simulation()
    require_gymnasium()
    from heron.cli.inserting import command

    command(output, learned)
