"""The subcommands for the start: they write the first files for a robot."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from rossmarie.cli.options import OptionalOutFile, RobotFolder, RobotName, written

Recording = Annotated[
    Path, typer.Argument(metavar="RECORDING", help="Any recording.", readable=False)
]


def model(recording: Recording, out: OptionalOutFile = None) -> None:
    """Write the system model of a recording: its topics and their types."""
    from rossmarie.cli.replay import write_model_of

    write_model_of(recording, out)


def init(
    recording: Annotated[
        Path,
        typer.Argument(
            metavar="RECORDING", help="A .bag, .db3, .mcap, or a bag folder.", readable=False
        ),
    ],
    out: Annotated[
        Path,
        typer.Option("--out", "-o", metavar="DIR", help="The folder to write to.", parser=written),
    ] = Path("robot"),
    force: Annotated[bool, typer.Option("--force", help="Replace files that are there.")] = False,
) -> None:
    """Begin the rules of a robot from a recording: a system model, inputs, proposals, tests."""
    from rossmarie.cli.init import run_init

    run_init(recording, out, force=force)


def example(robot: RobotName = None, folder: RobotFolder = None) -> None:
    """Copy the rules of a robot in the box, with a recording; without ROBOT, list the robots."""
    from rossmarie.cli.example import run_example

    run_example(robot, folder)
