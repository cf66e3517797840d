"""The experiments of the thesis: each in three arms, on the same seeds, with measures."""

from heron.experiments.human import HumanEpisode, HumanMeasures, run_human
from heron.experiments.measures import NavigationMeasures
from heron.experiments.navigation import NavigationEpisode, run_navigation
from heron.experiments.observer import Observer
from heron.experiments.placing import PlacingEpisode, PlacingMeasures, run_placing
from heron.experiments.runner import Node
from heron.experiments.table import EXPERIMENTS, Episode, Experiment, Measure

__all__ = [
    "EXPERIMENTS",
    "Episode",
    "Experiment",
    "HumanEpisode",
    "HumanMeasures",
    "Measure",
    "NavigationEpisode",
    "NavigationMeasures",
    "Node",
    "Observer",
    "PlacingEpisode",
    "PlacingMeasures",
    "run_human",
    "run_navigation",
    "run_placing",
]
