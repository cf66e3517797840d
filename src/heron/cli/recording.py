"""`heron record`: an episode as a file that is replayed."""

from __future__ import annotations

import enum
from pathlib import Path

import typer

from dslkit.command_line import CommandLine
from heron.cli.episodes import print_episode
from heron.experiments import EXPERIMENTS, USUAL
from heron.recording import Recorder
from heron.variants import Arm


def record(
    output: CommandLine,
    name: str,
    variant: enum.Enum,
    arm: Arm,
    seed: int,
    out: Path,
) -> None:
    """Run it, print it, write it."""
    experiment, recorder = EXPERIMENTS[name], Recorder()
    print_episode(experiment, experiment.run(arm, variant, seed, (recorder,), USUAL))
    with output.writing(out):
        recorder.write(out)
    typer.echo(f"the recording:  {out}")
