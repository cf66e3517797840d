"""The experiments of the thesis: each in three arms, on the same seeds, with measures."""

from heron.experiments.measures import NavigationMeasures
from heron.experiments.navigation import NavigationEpisode, run_navigation
from heron.experiments.placing import PlacingEpisode, PlacingMeasures, run_placing

__all__ = [
    "NavigationEpisode",
    "NavigationMeasures",
    "PlacingEpisode",
    "PlacingMeasures",
    "run_navigation",
    "run_placing",
]
