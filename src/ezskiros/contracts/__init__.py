"""Contracts between skills: conditions of a compound skill and of its children, along its tree."""

from ezskiros.contracts.completion import missing_pre_conditions
from ezskiros.contracts.contracts import Contracts, check_contracts
from ezskiros.contracts.findings import MissingCondition

__all__ = ["Contracts", "MissingCondition", "check_contracts", "missing_pre_conditions"]
