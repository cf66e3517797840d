"""Execution of user code for a check, in a child process that can have no side effects and cannot
end unnoticed.
"""

from ezskiros.confinement.report import RefusedError, Report, confined

__all__ = ["RefusedError", "Report", "confined"]
