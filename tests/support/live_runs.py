"""`ezskiros run` beside nodes of ROS, in live tests."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from support.live import Process, Ros, talking

_DEBIAN = "/usr/lib/python3/dist-packages"
"""Where Debian has rospy."""


def begun_run(ros: Ros, words: tuple[str, ...], log: Path, notes: Path, namespace: str) -> Process:
    """A task that runs in a namespace; its skills note what they do."""
    places = [ros.variables.get("PYTHONPATH", ""), *sys.path]
    if ros.name == "ros1":
        places.append(_DEBIAN)
    paths = os.pathsep.join(filter(None, places))
    variables = {**ros.variables, "PYTHONPATH": paths, "NOTES": str(notes)}
    variables["ROS_NAMESPACE"] = namespace
    return Process([sys.executable, "-m", "ezskiros", "run", *words], variables, log, talking)
