"""The experiments of the thesis: several arms each, on the same seeds, with measures."""

from heron.experiments.blocked import BlockedEpisode, BlockedMeasures, run_blocked
from heron.experiments.contact import ContactEpisode, ContactMeasures, run_contact
from heron.experiments.corridor import CorridorEpisode, CorridorMeasures, run_corridor
from heron.experiments.experiment import EpisodeFacts, Experiment, Measure
from heron.experiments.human import HumanEpisode, HumanMeasures, run_human
from heron.experiments.measures import NavigationMeasures
from heron.experiments.navigation import NavigationEpisode, run_navigation
from heron.experiments.observer import Observer
from heron.experiments.placing import PlacingEpisode, PlacingMeasures, run_placing
from heron.experiments.runner import SimulatedNode
from heron.experiments.second import run_second
from heron.experiments.settings import USUAL, Settings
from heron.experiments.studies import STUDIES, Study
from heron.experiments.table import EXPERIMENTS

__all__ = [
    "EXPERIMENTS",
    "STUDIES",
    "USUAL",
    "BlockedEpisode",
    "BlockedMeasures",
    "ContactEpisode",
    "ContactMeasures",
    "CorridorEpisode",
    "CorridorMeasures",
    "EpisodeFacts",
    "Experiment",
    "HumanEpisode",
    "HumanMeasures",
    "Measure",
    "NavigationEpisode",
    "NavigationMeasures",
    "Observer",
    "PlacingEpisode",
    "PlacingMeasures",
    "Settings",
    "SimulatedNode",
    "Study",
    "run_blocked",
    "run_contact",
    "run_corridor",
    "run_human",
    "run_navigation",
    "run_placing",
    "run_second",
]
