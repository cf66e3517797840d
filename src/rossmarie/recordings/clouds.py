"""The points of recorded clouds, as columns: NumPy takes all points of a message at once."""

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

from rossmarie.ir import POINTS, Array, List, Path, clouds

_CLOUD = "sensor_msgs/msg/PointCloud2"
_FIELD = "sensor_msgs/msg/PointField"
_UINT8, _UINT32, _BOOL, _STRING = (
    (Nodetype.BASE, (kind, 0)) for kind in ("uint8", "uint32", "bool", "string")
)
_NEEDED: Mapping[str, Mapping[str, Any]] = {
    _CLOUD: {
        "height": _UINT32,
        "width": _UINT32,
        "fields": (Nodetype.SEQUENCE, ((Nodetype.NAME, _FIELD), 0)),
        "is_bigendian": _BOOL,
        "point_step": _UINT32,
        "row_step": _UINT32,
        "data": (Nodetype.SEQUENCE, (_UINT8, 0)),
    },
    _FIELD: {"name": _STRING, "offset": _UINT32, "datatype": _UINT8, "count": _UINT32},
}
"""The fields that are read, in the form of rosbags. They are checked, because a recording contains
its own definitions.
"""


@dataclass(frozen=True)
class CloudReader:
    """Reads the points of one cloud in a message: `columns` are the arrays of the machine, with the
    names of their fields.
    """

    path: Path
    most: int
    columns: Mapping[int, str]

    def read(self, message: Any) -> dict[int, NDArray[np.float64]]:
        """The columns of a message. Raises `UnreadableCloudError`."""
        words = [normalize_fieldname(str(step)) for step in self.path]
        cloud = attrgetter(".".join(words))(message) if words else message
        found = clouds.columns(cloud, tuple(self.columns.values()), self.most)
        return dict(zip(self.columns, found, strict=True))


def is_of_points(array: Array) -> bool:
    """Say whether an array is a field of the points of a cloud."""
    return POINTS in array.path


def cloud_readers(arrays: Mapping[int, Array], lists: Sequence[List]) -> Iterator[CloudReader]:
    """A reader for each cloud of these `arrays` of points."""
    by_list: dict[int, dict[int, str]] = {}
    for index, array in arrays.items():
        if array.list is not None and is_of_points(array):
            by_list.setdefault(array.list, {})[index] = str(array.path[-1])
    for number, found in by_list.items():
        its_list = lists[number]
        yield CloudReader(its_list.path[: its_list.path.index(POINTS)], its_list.most, found)


def holds_cloud(description: Any, store: Typestore) -> bool:
    """Say whether a description, in the form of rosbags, is the description of a cloud."""
    if description != (Nodetype.NAME, _CLOUD):
        return False
    for kind, needed in _NEEDED.items():
        has = dict(store.fielddefs[kind][1]) if kind in store.fielddefs else {}
        if any(has.get(name) != field for name, field in needed.items()):
            return False
    return True
