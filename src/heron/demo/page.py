"""The page of the demo: one self-contained file."""

from __future__ import annotations

import base64
import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib.resources import files

from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape

from heron.demo.charts import HEIGHT, WIDTH, Chart, Tick, chart_of, time_ticks
from heron.demo.lanes import SIGNS, Lanes, rules_of, tree_of
from heron.demo.shots import Shot
from heron.experiments import EXPERIMENTS
from heron.experiments.experiment import ARM_NAMES
from heron.tasks.tree import running_of
from heron.variants import ExperimentArm

_SPEEDS = (1, 2, 4, 8)
_PLAYING_S = 20.0


@dataclass(frozen=True)
class Mark:
    """A hazard of an arm: when it began (s), and at how many percent of the time axis."""

    arm: ExperimentArm
    hazard: str
    time: float
    at: float


@dataclass(frozen=True)
class Section:
    """One experiment as the page shows it. `data` is for the script, as JSON; the player stands
    at `opening` (s) first.
    """

    name: str
    title: str
    about: str
    variant: str
    shown_first: Sequence[ExperimentArm]
    shots: Sequence[Shot]
    duration: float
    opening: float
    speed: int
    ticks: Sequence[Tick]
    marks: Sequence[Mark]
    charts: Sequence[Chart]
    rules: Sequence[Lanes]
    trees: Sequence[Lanes]
    rows: Sequence[tuple[str, Sequence[str]]]
    data: str


def page_of(shots: Sequence[Shot]) -> str:
    """HTML of all shots, by experiment."""
    environment = Environment(
        loader=PackageLoader("heron.demo", "assets"),
        autoescape=select_autoescape(["html.j2"], default=True),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    names = dict.fromkeys(shot.experiment for shot in shots)
    sections = [
        _section(name, [shot for shot in shots if shot.experiment == name]) for name in names
    ]
    palette = files("rossmarie.report").joinpath("assets/palette.css").read_text("utf-8")
    own = files("heron.demo").joinpath("assets")
    return environment.get_template("demo.html.j2").render(
        sections=sections,
        names=ARM_NAMES,
        speeds=_SPEEDS,
        style=palette + own.joinpath("demo.css").read_text("utf-8"),
        script=own.joinpath("demo.js").read_text("utf-8"),
        signs=[(status.value, sign) for status, sign in SIGNS.items()],
        width=WIDTH,
        height=HEIGHT,
    )


def _section(name: str, shots: Sequence[Shot]) -> Section:
    experiment = EXPERIMENTS[name]
    duration = max(shot.duration for shot in shots)
    return Section(
        name=name,
        title=f"Experiment {experiment.title}",
        about=experiment.about,
        variant=shots[0].title,
        shown_first=experiment.shown_first,
        shots=shots,
        duration=duration,
        opening=experiment.opening_of(shot.onsets for shot in _shown_first(shots)),
        speed=_speed(shots),
        ticks=time_ticks(duration),
        marks=list(_marks(name, shots, duration)),
        charts=[chart_of(signal, shots, duration) for signal in experiment.signals],
        rules=[rules_of(shot, duration) for shot in shots if shot.rules],
        trees=[tree_of(shot, duration) for shot in shots],
        rows=_rows(shots),
        data=_data(shots, duration),
    )


def _speed(shots: Sequence[Shot]) -> int:
    """The least speed at which the arms that are shown first are over in time, or the greatest."""
    longest = max((shot.duration for shot in _shown_first(shots)), default=shots[0].duration)
    return next((speed for speed in _SPEEDS if longest / speed <= _PLAYING_S), _SPEEDS[-1])


def _shown_first(shots: Sequence[Shot]) -> list[Shot]:
    shown = EXPERIMENTS[shots[0].experiment].shown_first
    return [shot for shot in shots if shot.arm in shown]


def _marks(name: str, shots: Sequence[Shot], duration: float) -> Iterator[Mark]:
    words = EXPERIMENTS[name].hazards
    for shot in shots:
        for hazard, time in shot.onsets.items():
            yield Mark(shot.arm, words[hazard], time, round(100 * time / duration, 3))


def _rows(shots: Sequence[Shot]) -> list[tuple[str, list[str]]]:
    """The measures of all arms, side by side."""
    labels = dict.fromkeys(label for shot in shots for label in shot.measures)
    return [(label, [shot.measures.get(label, "-") for shot in shots]) for label in labels]


def _data(shots: Sequence[Shot], duration: float) -> str:
    """JSON that cannot end the script element it stands in."""
    data = {
        "duration": duration,
        "films": [
            {
                "arm": shot.arm.value,
                "period": shot.frames.period,
                "duration": shot.duration,
                "rules": [[rule, *span] for rule, spans in shot.rules.items() for span in spans],
                "skills": running_of(shot.tree, shot.duration),
                "pictures": [base64.b64encode(one).decode() for one in shot.frames.pictures],
            }
            for shot in shots
        ],
    }
    return json.dumps(data, separators=(",", ":")).replace("<", "\\u003c")
