"""`heron run --film` and `heron gallery`: episodes as films."""

from __future__ import annotations

import enum
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import typer
from rich.console import Console

from dslkit.command_line import CommandLine
from heron.cli.episodes import print_episode
from heron.experiments import EXPERIMENTS
from heron.films import CannotDrawError, film_of
from heron.films.clip import Clip
from heron.films.gallery import EXHIBITS, FOLDER, PAGE, write_gallery
from heron.films.movie import write_movie
from heron.variants import ExperimentArm

_SIZE = (640, 360)


@contextmanager
def _drawing(output: CommandLine) -> Iterator[None]:
    """Show the progress, and the reason of a failure."""
    try:
        with Console(stderr=True).status("films are drawn"):
            yield
    except CannotDrawError as error:
        output.fail(
            f"no film: OpenGL cannot draw without a display ({error}); on Debian, install "
            "libegl1 and libgl1-mesa-dri",
            exit_code=2,
        )


def film(
    output: CommandLine, name: str, variant: enum.Enum, arm: ExperimentArm, seed: int, out: Path
) -> None:
    """Run an episode, print it, and write its film."""
    clip = film_of(EXPERIMENTS[name], variant, arm, seed)
    print_episode(clip.experiment, clip.episode)
    write_film(output, [clip], out)


def write_film(output: CommandLine, clips: Sequence[Clip], out: Path) -> None:
    """Write clips side by side."""
    with output.writing(out), _drawing(output):
        out.parent.mkdir(parents=True, exist_ok=True)
        write_movie(out, clips, _SIZE)
    typer.echo(f"the film:  {out}")


def show_gallery(output: CommandLine, seed: int, out: Path) -> None:
    """Films of episodes side by side, and a page with all of them."""
    output.try_folder(out, PAGE, *(f"{FOLDER}/{each.name}.webp" for each in EXHIBITS))
    with output.writing_to(out), _drawing(output):
        page = write_gallery(out, seed)
    typer.echo(f"the page:  {page}")
