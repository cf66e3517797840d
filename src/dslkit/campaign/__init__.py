"""Campaigns: many independent episodes, each with a key, in many processes.

Only the given function knows the content of an episode. Whatever happens, each reported result is
on disk, and an interrupted campaign continues where it stopped.
"""

from dslkit.campaign.journal import BusyError, ForeignError, Journal
from dslkit.campaign.processes import Processes, undisturbed
from dslkit.campaign.progress import Bar
from dslkit.campaign.runner import Campaign, FailedEpisode, run
from dslkit.campaign.workers import EpisodeResult, Scalar, UnreachableError, Value, Work, Workers

__all__ = [
    "Bar",
    "BusyError",
    "Campaign",
    "EpisodeResult",
    "FailedEpisode",
    "ForeignError",
    "Journal",
    "Processes",
    "Scalar",
    "UnreachableError",
    "Value",
    "Work",
    "Workers",
    "run",
    "undisturbed",
]
