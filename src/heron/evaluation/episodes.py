"""The episodes of an evaluation, by keys such as `nav/steep/deros/3`. The keys of a study begin
with the study and its value: `operator=10/nav/steep/deros/3`.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from importlib.metadata import version
from pathlib import Path

import ezskiros
import heron
import rossmarie
from dslkit.campaign import Value
from heron.experiments import EXPERIMENTS, STUDIES, USUAL, Experiment
from heron.variants import ExperimentArm

_KINDS = (".action", ".c", ".h", ".j2", ".json", ".lark", ".msg", ".py", ".ross", ".ttl", ".turtle")
# These have no say in how an episode goes.
_TELLING = (
    *("heron/appearance", "heron/cli", "heron/demo", "heron/evaluation", "heron/films"),
    *("ezskiros/cli", "ezskiros/drawing", "rossmarie/cli", "rossmarie/report"),
)


def keys_of(experiments: Iterable[Experiment], seeds: int) -> Iterator[str]:
    """Seed by seed, so that whatever is done first has all arms; then the studies."""
    chosen = list(experiments)
    for seed in range(seeds):
        for experiment in chosen:
            for variant in experiment.variants:
                for arm in experiment.arms:
                    yield f"{experiment.name}/{variant}/{arm.value}/{seed}"
    for study in STUDIES.values():
        for seed in range(min(seeds, study.seeds)):
            for case in study.cases:
                if case.of in chosen:
                    yield from (
                        f"{study.name}={value:g}/{case.key}/{seed}" for value in study.values
                    )


def row_of(key: str) -> Value:
    """Run an episode."""
    *changed, name, variant, arm, seed = key.split("/")
    experiment = EXPERIMENTS[name]
    study, value = changed[0].split("=") if changed else ("", "")
    settings = STUDIES[study].settings(float(value)) if changed else USUAL
    episode = experiment.run(
        ExperimentArm(arm), experiment.variants[variant], int(seed), (), settings
    )
    found = {one.name: one.of(episode.measures) for one in experiment.measures}
    measured = {
        measure: None if value is None else float(value) for measure, value in found.items()
    }
    of_study: Value = {"study": study, "value": value} if changed else {}
    return {
        **of_study,
        "experiment": name,
        "variant": variant,
        "arm": arm,
        "seed": int(seed),
        **measured,
    }


def sources() -> str:
    """A digest of everything that influences an episode. So results of different programs do not
    get into one table.
    """
    digest = hashlib.sha256()
    for package in (ezskiros, heron, rossmarie):
        folder = Path(str(package.__file__)).parent
        for path in sorted(folder.rglob("*")):
            place = path.relative_to(folder)
            if path.suffix in _KINDS and f"{package.__name__}/{place.parts[0]}" not in _TELLING:
                digest.update(f"{place}\0".encode() + path.read_bytes())
    return f"Heron {digest.hexdigest()[:12]} on MuJoCo {version('mujoco')}"
