"""Campaigns: many episodes that do not know of each other, each with a key, in many processes.

What an episode is, only the function knows that is given here. Whatever happens, each result that
was reported is on disk, and a campaign that was interrupted goes on where it was.
"""

from campaign.journal import BusyError, ForeignError, Journal
from campaign.processes import Processes, undisturbed
from campaign.progress import Bar
from campaign.runner import Campaign, Failure, run
from campaign.workers import Result, Scalar, UnreachableError, Value, Work, Workers

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
