"""The page of the demo: one file that needs nothing else."""

from __future__ import annotations

import base64
import json
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files

from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape

from heron.demo.charts import RIGHT, WIDTH, Axis, Chart, chart_of
from heron.demo.lanes import SIGNS, Lanes, axis_of, rules_of, running_of, tree_of
from heron.demo.shots import Shot
from heron.experiments import EXPERIMENTS
from heron.experiments.table import ARM_NAMES

_PLAYING_S = 14.0


@dataclass(frozen=True)
class Section:
    """What the page shows of one experiment. `data` is for the script, as JSON."""

    name: str
    title: str
    variant: str
    shots: Sequence[Shot]
    axis: Axis
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
        style=palette + own.joinpath("demo.css").read_text("utf-8"),
        script=own.joinpath("demo.js").read_text("utf-8"),
        signs=[(status.value, sign) for status, sign in SIGNS.items()],
        width=WIDTH,
        right=WIDTH - RIGHT,
    )


def _section(name: str, shots: Sequence[Shot]) -> Section:
    experiment = EXPERIMENTS[name]
    axis = axis_of(shots)
    return Section(
        name=name,
        title=f"Experiment {experiment.title}",
        variant=shots[0].title,
        shots=shots,
        axis=axis,
        charts=[chart_of(signal, shots, axis) for signal in experiment.signals],
        rules=[rules_of(shot, axis) for shot in shots if shot.rules],
        trees=[tree_of(shot, axis) for shot in shots],
        rows=_rows(shots),
        data=_data(shots, axis.duration),
    )


def _rows(shots: Sequence[Shot]) -> list[tuple[str, list[str]]]:
    """The measures of all arms beside each other."""
    labels = dict.fromkeys(label for shot in shots for label in shot.measures)
    return [(label, [shot.measures.get(label, "-") for shot in shots]) for label in labels]


def _data(shots: Sequence[Shot], duration: float) -> str:
    """JSON that cannot end the script element it stands in."""
    data = {
        "duration": duration,
        "speed": max(1.0, duration / _PLAYING_S),
        "films": [
            {
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
