"""Checks of skills against the ontology and against each other."""

from ezskiros.check.skills import check_skills
from ezskiros.check.trees import check_implementations

__all__ = ["check_implementations", "check_skills"]
