"""Options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from heron.variants import ALGORITHMS, VARIANTS, ExperimentArm

_LATEST_S = 4_000_000_000
"""Stamps of ROS have 32 bits for seconds."""


def _variants(ctx: typer.Context) -> list[str]:
    """The variants of the experiments that the command line names."""
    return [each.value for name in _typed(ctx) for each in VARIANTS.get(name, ())]


def _algorithms(ctx: typer.Context) -> list[str]:
    """The algorithms of the formulations that the command line names."""
    return [
        each for known in ALGORITHMS if known.value in _typed(ctx) for each in ALGORITHMS[known]
    ]


def _typed(ctx: typer.Context) -> list[str]:
    """The words before the word to complete: parsed, or left over if an option has no value."""
    return [*map(str, ctx.args), *(str(each) for each in ctx.params.values() if each)]


Experiment = Annotated[
    str,
    typer.Argument(
        help="The experiment: nav, place, human, contact, corridor, blocked or second.",
        autocompletion=lambda: list(VARIANTS),
    ),
]
Experiments = Annotated[
    list[str] | None,
    typer.Option(
        "--experiment",
        help="An experiment; repeat the option for several. Default: all.",
        autocompletion=lambda: list(VARIANTS),
    ),
]
Variant = Annotated[
    str | None,
    typer.Option(
        "--variant",
        help="A terrain, table, person or other variant; default: the first one.",
        autocompletion=_variants,
    ),
]
Algorithms = Annotated[
    list[str] | None,
    typer.Option(
        "--algorithm",
        help="A training algorithm; repeat the option for several. Default: the first one.",
        autocompletion=_algorithms,
    ),
]
Guarding = Annotated[ExperimentArm, typer.Option("--arm", help="The guard of the robot.")]
View = Annotated[bool, typer.Option("--view", help="Show the episode in a window, in real time.")]
Filming = Annotated[
    Path | None,
    typer.Option("--film", metavar="FILE", help="Write a film to this file (.mp4 or .gif)."),
]
Seed = Annotated[int, typer.Option("--seed", min=0, help="Random seed.")]
Jobs = Annotated[
    int | None, typer.Option(min=1, help="The number of parallel processes; default: one per core.")
]
Ray = Annotated[
    str | None,
    typer.Option(metavar="ADDRESS", help="Run on the Ray cluster at this host:port."),
]
Begin = Annotated[
    int,
    typer.Option(
        "--begin", min=0, max=_LATEST_S, help="The time stamp of the first message, in seconds."
    ),
]
RecordingFile = Annotated[
    Path, typer.Option("--out", "-o", metavar="FILE", help="The output file, such as drive.mcap.")
]
TraceFile = Annotated[
    Path | None,
    typer.Option(
        "--trace", metavar="FILE", help="Also write the skill trace, for `ezskiros learn`."
    ),
]
PageFile = Annotated[Path, typer.Option("--out", "-o", metavar="FILE", help="The output file.")]
RunsFolder = Annotated[
    Path,
    typer.Option(
        "--out",
        "-o",
        metavar="DIR",
        help="The output folder; finished runs in it are reused.",
    ),
]
