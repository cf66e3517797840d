"""A guard in this process: rules decide which actions of a program, or a policy, reach a robot."""

from rossmarie.engines import Value
from rossmarie.guard.batch import BatchDecision, GuardBatch
from rossmarie.guard.commands import UPDATE_PERIOD_NS, CommandFilter, Commands
from rossmarie.guard.core import Core
from rossmarie.guard.decision import Decision, Request
from rossmarie.guard.feedback import FeedbackMeter
from rossmarie.guard.guard import Guard
from rossmarie.guard.mapping import Declared, MappingError, Place
from rossmarie.guard.state import GuardState

__all__ = [
    "UPDATE_PERIOD_NS",
    "BatchDecision",
    "CommandFilter",
    "Commands",
    "Core",
    "Decision",
    "Declared",
    "FeedbackMeter",
    "Guard",
    "GuardBatch",
    "GuardState",
    "MappingError",
    "Place",
    "Request",
    "Value",
]
