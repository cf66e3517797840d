"""A page of films: without a monitor and with one, side by side."""

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
from heron.variants import Arm, Blockage, Encounter, Passage, Person, Table, Terrain, Trouble

PAGE = "gallery.md"
FOLDER = "gallery"
_SIZE = (400, 225)


@dataclass(frozen=True)
class Exhibit:
    """Episodes of a variant, and what there is to see in their film."""

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
        "A bump, and a ramp that needs more torque than the base usually gives. Without a monitor "
        "the base hits the bump at full speed and stalls on the ramp. The rules slow it down on "
        "the bump and let it push on the ramp, until the ground is level again.",
    ),
    Exhibit(
        "nav",
        Terrain.STEEP,
        "The same corridor with a ramp of 25 degrees. Without a monitor the base stalls at its "
        "toe. The rules let it back off, and take the other way into the room.",
    ),
    Exhibit(
        "place",
        Table.HIGH,
        "A table that is higher than the arm believes. Without a monitor the arm hammers on it "
        "until it lets go. The rules let it retract, soften, and place the block once more.",
    ),
    Exhibit(
        "human",
        Person.INSIDE,
        "Somebody comes into the room where the arm works. Without a monitor it goes on at full "
        "speed beside them. With rules it is slower as soon as they are in the room, stands still "
        "before they are within its reach, gives way when they push it, and goes on when they "
        "have left.",
    ),
    Exhibit(
        "contact",
        Encounter.COLLISION,
        "The arm pushes a box and wipes a board. In between it hits a forearm. Without a monitor "
        "it presses on until the forearm is drawn back. The rules know that pushing and wiping "
        "need contact, and let it be; on the forearm they let the arm back off at once.",
    ),
    Exhibit(
        "corridor",
        Passage.CHILD,
        "The base drives along a corridor, and a child runs out of a door. Without a monitor the "
        "base hits the child at full speed. The rules know which part of the corridor belongs to a "
        "school: the base is slow there before any sensor sees a child, and stands in time.",
    ),
    Exhibit(
        "blocked",
        Blockage.PALLET,
        "A pallet stands across the short way to a hall. Without a monitor the base stands before "
        "it until an operator takes it away. The rules let the base run a behavior tree: it waits, "
        "turns back to the junction, and marks the way as blocked. Then the planner finds the "
        "other way.",
    ),
    Exhibit(
        "second",
        Trouble.LASTING,
        "The same scene, where a pallet stands across the short way in most runs. Without "
        "knowledge of earlier runs the planner takes the short way, and the base loses time there. "
        "With what `ezskiros learn` has counted in other runs, it takes the way by the yard.",
    ),
)


def write_gallery(out: Path, seed: int) -> Path:
    """The page, and beside it a folder with the films. Raises `CannotDrawError` and `OSError`."""
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
        f"Each film shows two episodes with the same seed ({seed}), at the same time and speed.",
        "The line below a picture has the skill that runs, and the rules that are active.",
        "[The experiments](experiments.md) has the figures of many seeds.",
        "",
    ]
    for exhibit in exhibits:
        experiment = EXPERIMENTS[exhibit.experiment]
        title = f"{experiment.title}, {exhibit.variant.value}"
        first, last = experiment.shown_first
        without = "without a monitor" if first is Arm.NONE else f"with {ARM_NAMES[first]}"
        guard = ARM_NAMES[last]
        lines += [
            f"## {title}",
            "",
            exhibit.words,
            "",
            f"![{title}: {without}, and with {guard}]({FOLDER}/{exhibit.name}.webp)",
            "",
            "For a film of your own, of one episode, as MP4 or GIF:",
            "",
            f"    heron run {exhibit.experiment} --variant {exhibit.variant.value} "
            f"--seed {seed} --film {exhibit.name}.mp4",
            "",
        ]
    return "\n".join(lines)
