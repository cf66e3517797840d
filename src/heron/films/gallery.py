"""A page of films, without and with a monitor side by side."""

from __future__ import annotations

import enum
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit.ownership import Comment, list_written, marked
from dslkit.writing import write_whole
from heron.experiments import EXPERIMENTS
from heron.experiments.experiment import ARM_NAMES
from heron.films.episode import film_of
from heron.films.movie import write_movie
from heron.films.processes import in_processes
from heron.variants import (
    Blockage,
    Encounter,
    ExperimentArm,
    Passage,
    Person,
    Table,
    Terrain,
    Trouble,
)

PAGE = "gallery.md"
FOLDER = "gallery"
_SIZE = (400, 225)


@dataclass(frozen=True)
class Exhibit:
    """Episodes of a variant, and the caption of their film."""

    experiment: str
    variant: enum.Enum
    words: str

    @property
    def name(self) -> str:
        """`nav-gentle`."""
        return f"{self.experiment}-{self.variant.value}"


EXHIBITS = (
    Exhibit(
        "nav",
        Terrain.GENTLE,
        "The base drives over a bump and up a ramp that needs more than its normal torque. Without "
        "a monitor, the base hits the bump at full speed and stalls on the ramp. The rules slow "
        "the base down on the bump, and raise its torque limit until the ground is level again.",
    ),
    Exhibit(
        "nav",
        Terrain.STEEP,
        "The same corridor has a ramp of 25 degrees. Without a monitor, the base stalls at the "
        "foot of the ramp. The rules make the base back off, and take the other path to the room.",
    ),
    Exhibit(
        "place",
        Table.HIGH,
        "The table is higher than the arm's model of it. Without a monitor, the arm hammers on the "
        "table until it releases the block. The rules make the arm retract, lower its stiffness, "
        "and place the block again.",
    ),
    Exhibit(
        "human",
        Person.INSIDE,
        "A person enters the room where the arm works. Without a monitor, the arm continues at "
        "full speed beside the person. The rules slow the arm down when the person enters the "
        "room, and stop the arm before the person is within its reach. The arm yields when the "
        "person pushes it, and continues when the person has left.",
    ),
    Exhibit(
        "contact",
        Encounter.COLLISION,
        "The arm pushes a box and wipes a board. In between, the arm hits a forearm. Without a "
        "monitor, the arm keeps pressing until the person draws the forearm back. The rules know "
        "that pushing and wiping need contact, and permit it. When the arm hits the forearm, the "
        "rules make the arm back off at once.",
    ),
    Exhibit(
        "corridor",
        Passage.CHILD,
        "The base drives along a corridor, and a child runs out of a door. Without a monitor, the "
        "base hits the child at full speed. The rules know which part of the corridor belongs to a "
        "school. The base is slow there before any sensor sees a child, and stops in time.",
    ),
    Exhibit(
        "blocked",
        Blockage.PALLET,
        "A pallet blocks the short path to a hall. Without a monitor, the base waits in front of "
        "the pallet until an operator removes it. The rules start a behavior tree: the base waits, "
        "turns back to the junction, and marks the path as blocked. Then the planner finds the "
        "other path.",
    ),
    Exhibit(
        "second",
        Trouble.LASTING,
        "In the same scene, a pallet blocks the short path in most runs. Without knowledge of "
        "earlier runs, the planner takes the short path, and the base loses time there. With the "
        "counts of `ezskiros learn` from earlier runs, the planner takes the path through the "
        "yard.",
    ),
)


def write_gallery(out: Path, seed: int) -> Path:
    """Write the page, and next to the page a folder with the films. Raises `CannotDrawError` and
    `OSError`.
    """
    folder = out / FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder) as unfinished:
        films = [(each, seed, Path(unfinished) / f"{each.name}.webp") for each in EXHIBITS]
        in_processes(_write_film, films)
        for _, _, film in films:
            film.replace(folder / film.name)
    page = out / PAGE
    list_written(folder, [film.name for _, _, film in films], "heron")
    write_whole(page, marked(page_of(EXHIBITS, seed), "heron", Comment.MARKUP))
    return page


def _write_film(exhibit: Exhibit, seed: int, path: Path) -> None:
    experiment = EXPERIMENTS[exhibit.experiment]
    clips = [film_of(experiment, exhibit.variant, arm, seed) for arm in experiment.shown_first]
    write_movie(path, clips, _SIZE)


def page_of(exhibits: Sequence[Exhibit], seed: int) -> str:
    """The page, in Markdown."""
    lines = [
        "# Gallery",
        "",
        "<!-- Written by `heron gallery`; do not edit. -->",
        "",
        f"Each film shows two episodes with the same seed ({seed}), synchronized in time.",
        "The line below each picture shows the running skill and the active rules.",
        "[The experiments](experiments.md) page has the figures of many seeds.",
        "",
    ]
    for exhibit in exhibits:
        experiment = EXPERIMENTS[exhibit.experiment]
        title = f"{experiment.title}, {exhibit.variant.value}"
        first, last = experiment.shown_first
        without = "without a monitor" if first is ExperimentArm.NONE else f"with {ARM_NAMES[first]}"
        guard = ARM_NAMES[last]
        lines += [
            f"## {title}",
            "",
            exhibit.words,
            "",
            f"![{title}: {without}, and with {guard}]({FOLDER}/{exhibit.name}.webp)",
            "",
            "Make a film of one episode, as MP4 or GIF:",
            "",
            f"    heron run {exhibit.experiment} --variant {exhibit.variant.value} "
            f"--seed {seed} --film {exhibit.name}.mp4",
            "",
        ]
    return "\n".join(lines)
