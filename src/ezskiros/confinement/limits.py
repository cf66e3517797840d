"""Limits of a process that runs checked code: on its resources, and on its system calls."""

from __future__ import annotations

import resource
import sys

from ezskiros.confinement.calls import confine_calls
from ezskiros.confinement.unconfined import UnconfinedError

MEMORY = 4 << 30
_FILES = 1024
_LIMITS = {
    resource.RLIMIT_CORE: 0,
    resource.RLIMIT_DATA: MEMORY,
    resource.RLIMIT_FSIZE: 0,
    resource.RLIMIT_NOFILE: _FILES,
}


def confine() -> None:
    """Confine this process for its whole life. Raises `UnconfinedError` if the system can only
    limit its resources.
    """
    limits = dict(_LIMITS)
    if sys.platform != "linux":
        limits[resource.RLIMIT_NPROC] = 0  # Linux counts threads, too
    for limit, most in limits.items():
        _, hard = resource.getrlimit(limit)
        allowed = most if hard == resource.RLIM_INFINITY else min(most, hard)
        resource.setrlimit(limit, (allowed, allowed))
    if sys.platform != "linux":
        raise UnconfinedError(f"there is no seccomp on {sys.platform}")
    confine_calls()
