"""Runs the users' code of a check in a child process that can do nothing to the world, and that
cannot end without a word.
"""

from ezskiros.confinement.report import RefusedError, Report, confined

__all__ = ["RefusedError", "Report", "confined"]
