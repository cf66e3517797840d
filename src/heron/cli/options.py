"""Options that several commands have."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from heron.variants import Arm

Guarding = Annotated[Arm, typer.Option("--arm", help="What guards the robot.")]
View = Annotated[bool, typer.Option("--view", help="Show it in a window, in real time.")]
Filming = Annotated[
    Path | None,
    typer.Option("--film", metavar="FILE", help="Write a film of it: FILE ends in .mp4 or .gif."),
]
Seed = Annotated[int, typer.Option("--seed", min=0, help="Random seed.")]
Jobs = Annotated[
    int | None, typer.Option(min=1, help="Processes at a time; one for each core if not given.")
]
Ray = Annotated[
    str | None,
    typer.Option(metavar="ADDRESS", help="Run on the Ray cluster at this host:port instead."),
]
