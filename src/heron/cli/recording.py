"""`heron record`: an episode as a file for replay."""

from __future__ import annotations

import enum
from dataclasses import dataclass
from pathlib import Path

import typer

from dslkit.command_line import CommandLine
from heron.cli.episodes import print_episode
from heron.experiments import EXPERIMENTS, USUAL
from heron.recording import Recorder, write_trace
from heron.tasks import SkillTask
from heron.variants import ExperimentArm


@dataclass(frozen=True)
class Files:
    """The files of an episode: the recording, and the trace of its skills, if one is wanted. Their
    stamps begin at `began_ns`.
    """

    recording: Path
    trace: Path | None
    began_ns: int


def record(
    output: CommandLine, name: str, variant: enum.Enum, arm: ExperimentArm, seed: int, files: Files
) -> None:
    """Run it, print it, write it."""
    experiment, recorder = EXPERIMENTS[name], Recorder(files.began_ns)
    episode = experiment.run(arm, variant, seed, (recorder,), USUAL)
    print_episode(experiment, episode)
    with output.writing(files.recording):
        recorder.write(files.recording)
    typer.echo(f"the recording:  {files.recording}")
    if files.trace is not None:
        with output.writing(files.trace):
            write_trace(files.trace, episode.events, SkillTask.period_ns, files.began_ns)
        typer.echo(f"the trace:      {files.trace}")
