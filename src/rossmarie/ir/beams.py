"""The arrays of a machine that contain beams of a `sensor_msgs/LaserScan` (S71 to S73).

`scans.py` takes their numbers from a scan, with numpy, which most commands never need.
"""

from __future__ import annotations

from rossmarie.ir.model import Array
from rossmarie.ir.path import Beams, Path, Sector

USUAL_DISTANCES = (0.05, 30.0)
"""The range of distances in m that a scan of a test measures by default."""


def is_of_scan(array: Array) -> bool:
    """Say whether an array is computed from a whole scan."""
    return scan_path(array.path) is not None


def scan_path(path: Path) -> Path | None:
    """The path of the scan at whose beams a path ends; None for any other path."""
    for place, step in enumerate(path):
        if isinstance(step, Sector):
            return path[: place - 1]  # in front of `ranges`
        if isinstance(step, Beams):
            return path[:place]
    return None
