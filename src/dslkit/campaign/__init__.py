"""Campaigns: many episodes that do not know of each other, each with a key, in many processes.

What an episode is, only the function knows that is given here. Whatever happens, each result that
was reported is on disk, and a campaign that was interrupted goes on where it was.
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
