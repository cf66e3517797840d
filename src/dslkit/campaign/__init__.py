"""Campaigns: many independent episodes, each with a key, in many processes.

Only the given function knows the content of an episode. Whatever happens, each reported result is
on disk, and an interrupted campaign continues where it stopped.
"""

from dslkit.campaign.journal import BusyError, ForeignError, Journal
from dslkit.campaign.processes import Processes, undisturbed
from dslkit.campaign.progress import Bar
from dslkit.campaign.runner import Campaign, Failure, run
from dslkit.campaign.workers import Result, Scalar, UnreachableError, Value, Work, Workers

__all__ = [
    "Bar",
    "BusyError",
    "Campaign",
    "Failure",
    "ForeignError",
    "Journal",
    "Processes",
    "Result",
    "Scalar",
    "UnreachableError",
    "Value",
    "Work",
    "Workers",
    "run",
    "undisturbed",
]
