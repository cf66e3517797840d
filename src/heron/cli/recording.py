"""`heron record`: an episode as a file that is replayed."""

from __future__ import annotations

from pathlib import Path

import typer

from dslkit.command_line import CommandLine
from heron.cli.episodes import print_episode
from heron.experiments import Experiment
from heron.recording import Recorder
from heron.variants import Arm


def record(
    output: CommandLine,
    experiment: Experiment,
    variant: str | None,
    arm: Arm,
    seed: int,
    out: Path,
) -> None:
    """Run it, print it, write it."""
    chosen = variant or next(iter(experiment.variants))
    if chosen not in experiment.variants:
        there_are = ", ".join(experiment.variants)
        output.fail(
            f"{experiment.name} has no variant {chosen}; there are {there_are}", exit_code=2
        )
    if out.suffix != ".mcap":
        output.fail(f"the name of the recording has to end in .mcap, not as {out}", exit_code=2)
    if out.exists():
        output.fail(f"{out} is there already, and is not written over", exit_code=2)
    recorder = Recorder()
    print_episode(experiment, experiment.run(arm, experiment.variants[chosen], seed, (recorder,)))
    try:
        recorder.write(out)
    except OSError as error:
        output.fail(f"cannot write {out}: {error.strerror}", exit_code=2)
    typer.echo(f"the recording:  {out}")
