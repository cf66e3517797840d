"""The arrays of a machine that contain beams of a `sensor_msgs/LaserScan` (S71 to S73).

`scans.py` computes their numbers from a scan with NumPy, which most commands do not need.
"""

from __future__ import annotations

from rossmarie.ir.model import Array
from rossmarie.ir.path import Beams, Path, Sector

USUAL_DISTANCES = (0.05, 30.0)
"""The default range of distances in m that a scan of a test measures."""


def is_of_scan(array: Array) -> bool:
    """Say whether an array is computed from a whole scan."""
    return scan_path(array.path) is not None


def scan_path(path: Path) -> Path | None:
    """The path of the scan, if a path ends with beams of the scan; None for any other path."""
    for place, step in enumerate(path):
        if isinstance(step, Sector):
            return path[: place - 1]  # the path before `ranges`
        if isinstance(step, Beams):
            return path[:place]
    return None
