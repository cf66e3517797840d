"""Experiment VII, the second run: in the scene of experiment VI, an obstacle blocks the short route
to the hall in most runs. A robot that has learned from earlier runs plans with this knowledge.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from dslkit.diagnostics import Diagnostic
from ezskiros.learning.knowledge import read_knowledge
from ezskiros.learning.lessons import Cost
from heron.experiments.blocked import BlockedEpisode, Delivery, delivered, seeded_generators
from heron.experiments.observer import Observer
from heron.experiments.obstacles import troubled
from heron.experiments.settings import USUAL, Settings
from heron.scene import PathsParameters
from heron.skills import FOLDER
from heron.variants import ExperimentArm, Trouble

TEACHING_SEEDS = range(100, 112)
"""The seeds of the runs that are learned from: none of them is evaluated."""


def run_second(
    arm: ExperimentArm,
    trouble: Trouble,
    seed: int,
    observers: Sequence[Observer] = (),
    settings: Settings = USUAL,
) -> BlockedEpisode:
    """One episode. The same arguments give the same episode, number for number."""
    generators = seeded_generators(seed)
    obstacles = troubled(trouble, PathsParameters(), generators["obstacles"])
    costs = learned(trouble) if arm is ExperimentArm.LEARNED else ()
    return delivered(
        Delivery(arm, trouble, seed, obstacles, costs), generators, observers, settings
    )


def knowledge_of(trouble: Trouble) -> Path:
    """The file that `ezskiros learn` wrote after the runs of a variant."""
    return FOLDER / "learned" / f"{trouble.value}.json"


def learned(trouble: Trouble) -> Sequence[Cost]:
    """The costs of skills, as runs of a variant have taught them. Raises `ValueError` if the file
    is none, and `OSError` if there is none.
    """
    found = read_knowledge(knowledge_of(trouble))
    if isinstance(found, Diagnostic):
        raise ValueError(found.title)
    return found.lessons.costs
