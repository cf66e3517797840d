"""The beams of recorded scans, as columns: NumPy takes all beams of a message at once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from operator import attrgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rosbags.interfaces import Nodetype
from rosbags.typesys.base import normalize_fieldname
from rosbags.typesys.store import Typestore

from rossmarie.ir import Array, List, Path, scans
from rossmarie.ir.beams import scan_path

_SCAN = "sensor_msgs/msg/LaserScan"
_FLOAT = (Nodetype.BASE, ("float32", 0))
_FLOATS = (Nodetype.SEQUENCE, (_FLOAT, 0))
_NEEDED: Mapping[str, Any] = {
    **dict.fromkeys(
        ("angle_min", "angle_max", "angle_increment", "range_min", "range_max"), _FLOAT
    ),
    **dict.fromkeys(("ranges", "intensities"), _FLOATS),
}
"""The fields that are read, in the form of rosbags. They are checked, because a recording contains
its own definitions.
"""


@dataclass(frozen=True)
class ScanReader:
    """Reads a sector, or the columns of a list of beams, of one scan in a message: `columns` are
    the arrays of the machine.
    """

    path: Path
    most: int
    columns: Mapping[int, Array]

    def read(self, message: Any) -> dict[int, NDArray[np.float64]]:
        """The columns of a message. Raises `UnreadableScanError`."""
        words = [normalize_fieldname(str(step)) for step in self.path]
        scan = attrgetter(".".join(words))(message) if words else message
        return {index: scans.taken(scan, array, self.most) for index, array in self.columns.items()}


def scan_readers(arrays: Mapping[int, Array], lists: Sequence[List]) -> Iterator[ScanReader]:
    """A reader for each sector, and for each list of beams."""
    by_list: dict[int, dict[int, Array]] = {}
    for index, array in arrays.items():
        path = scan_path(array.path)
        if path is not None and array.list is None:
            yield ScanReader(path, 0, {index: array})
        elif path is not None and array.list is not None:
            by_list.setdefault(array.list, {})[index] = array
    for number, found in by_list.items():
        path = scan_path(lists[number].path)
        assert path is not None, "its columns are of a scan"
        yield ScanReader(path, lists[number].most, found)


def holds_scan(description: Any, store: Typestore) -> bool:
    """Say whether a description, in the form of rosbags, is the description of a scan."""
    if description != (Nodetype.NAME, _SCAN) or _SCAN not in store.fielddefs:
        return False
    has = dict(store.fielddefs[_SCAN][1])
    return all(has.get(name) == field for name, field in _NEEDED.items())
