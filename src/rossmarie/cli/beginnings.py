"""The subcommands for the start: they write the first files for a robot."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from dslkit.options import Force
from rossmarie.cli.options import OptionalOutFile, RobotFolder, RobotName, written
from rossmarie.cli.output import output

Recording = Annotated[
    Path,
    typer.Argument(
        metavar="RECORDING", help="A recording: .bag, .db3, .mcap, or a bag folder.", readable=False
    ),
]


def model(recording: Recording, out: OptionalOutFile = None, force: Force = False) -> None:
    """Write the system model of a recording: its topics and their types."""
    output.permit(force)
    from rossmarie.cli.replay import write_model_of

    write_model_of(recording, out)


def init(
    recording: Annotated[
        Path,
        typer.Argument(
            metavar="RECORDING",
            help="A recording: .bag, .db3, .mcap, or a bag folder.",
            readable=False,
        ),
    ],
    out: Annotated[
        Path,
        typer.Option("--out", "-o", metavar="DIR", help="The output folder.", parser=written),
    ] = Path("robot"),
    force: Force = False,
) -> None:
    """Write first rules from a recording: a system model, inputs, proposals, tests."""
    output.permit(force)
    from rossmarie.cli.init import run_init

    run_init(recording, out)


def example(robot: RobotName = None, folder: RobotFolder = None, force: Force = False) -> None:
    """Copy the example rules and recording of a robot; without ROBOT, list the robots."""
    output.permit(force)
    from rossmarie.cli.example import run_example

    run_example(robot, folder)
