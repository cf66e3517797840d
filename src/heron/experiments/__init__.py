"""The experiments of the thesis: each in three arms, on the same seeds, with measures."""

from heron.experiments.human import HumanEpisode, HumanMeasures, run_human
from heron.experiments.measures import NavigationMeasures
from heron.experiments.navigation import NavigationEpisode, run_navigation
from heron.experiments.placing import PlacingEpisode, PlacingMeasures, run_placing

__all__ = [
    "HumanEpisode",
    "HumanMeasures",
    "NavigationEpisode",
    "NavigationMeasures",
    "PlacingEpisode",
    "PlacingMeasures",
    "run_human",
    "run_navigation",
    "run_placing",
]
