"""The points of a `sensor_msgs/PointCloud2`: from its bytes to columns of numbers (S56, S57).

A cloud describes the fields of its points, and their places in its bytes. This description is
checked: a cloud that contradicts itself is unknown.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol, TypeGuard

import numpy as np
from numpy.typing import NDArray

from rossmarie.ir.path import AXES
from rossmarie.ir.wiring import PointColumns

_KINDS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
"""The NumPy types, by the `datatype` of a `sensor_msgs/PointField`."""

_MOST_NAMED = 16
"""The number of fields that an error message lists; a malicious cloud may have millions."""

_SINGLE = (0, 1)
"""The values of `count` for a single number; PCL writes 0 for it, too."""


class Cloud(Protocol):
    """An object of any class with the fields of the message."""

    height: int
    width: int
    fields: Sequence[Any]
    is_bigendian: bool
    point_step: int
    row_step: int
    data: Any


class UnreadableCloudError(Exception):
    """The reason why the points of a cloud are unknown."""


@dataclass(frozen=True)
class _Layout:
    """The layout of the points: numbers that are consistent with each other and with the size of
    the data.
    """

    rows: int
    columns: int
    row_step: int
    point_step: int

    @property
    def needed(self) -> int:
        """The bytes from the first to the end of the last point."""
        if not self.rows or not self.columns:
            return 0
        return (self.rows - 1) * self.row_step + self.columns * self.point_step


def is_cloud(value: object) -> TypeGuard[Cloud]:
    """Say whether a value looks like the message of a cloud."""
    return hasattr(value, "point_step") and hasattr(value, "data")


def columns(cloud: Cloud, names: Sequence[str], most: int) -> list[NDArray[np.float64]]:
    """The numbers of all points with a position, for each of the fields `names`.

    Raises `UnreadableCloudError` if the cloud has more than `most` points, including those without
    a position, does not have one of the fields, or contradicts itself.
    """
    layout = _layout(cloud, most)
    data = np.frombuffer(memoryview(cloud.data), np.uint8)
    if layout.needed > len(data):
        raise UnreadableCloudError(f"it has {len(data)} bytes of {layout.needed}")
    fields = [str(field.name) for field in cloud.fields]
    axes = [axis for axis in AXES if axis in fields]
    found = {
        name: _column(cloud, name, fields, layout, data) for name in dict.fromkeys((*names, *axes))
    }
    is_there = np.ones(layout.rows * layout.columns, np.bool_)
    for axis in axes:
        is_there &= ~np.isnan(found[axis])
    return [found[name][is_there] for name in names]


def _layout(cloud: Cloud, most: int) -> _Layout:
    layout = _Layout(
        int(cloud.height), int(cloud.width), int(cloud.row_step), int(cloud.point_step)
    )
    if layout.rows * layout.columns > most:
        raise UnreadableCloudError(f"it has more than {most} points")
    if layout.rows > 1 and layout.row_step < layout.columns * layout.point_step:
        raise UnreadableCloudError("its rows overlap")
    return layout


def _column(
    cloud: Cloud, name: str, fields: Sequence[str], layout: _Layout, data: NDArray[np.uint8]
) -> NDArray[np.float64]:
    """One field of all points, row after row."""
    if fields.count(name) != 1:
        if name not in fields:
            has = ", ".join(map(str, fields[:_MOST_NAMED])) or "none"
            raise UnreadableCloudError(f"its points have no field `{name}`; they have {has}")
        raise UnreadableCloudError(f"its points have several fields `{name}`")
    field = cloud.fields[fields.index(name)]
    kind = _KINDS.get(int(field.datatype))
    if kind is None or int(field.count) not in _SINGLE:
        raise UnreadableCloudError(f"its field `{name}` is not one number")
    type_ = np.dtype(kind).newbyteorder(">" if cloud.is_bigendian else "<")
    if int(field.offset) + type_.itemsize > layout.point_step:
        raise UnreadableCloudError(f"its field `{name}` lies after the end of the point")
    shape = (layout.rows, layout.columns)
    if 0 in shape:
        return np.empty(0)
    # A single row may state any step to the next row, because there is none.
    steps = (layout.row_step if layout.rows > 1 else 0, layout.point_step)
    numbers: NDArray[Any] = np.ndarray(shape, type_, data, int(field.offset), steps)
    with np.errstate(invalid="ignore"):  # all kinds of NaN become the same NaN
        return numbers.astype(np.float64).ravel()


def leave_out(cloud: PointColumns, arrays: dict[int, Sequence[float]]) -> None:
    """Remove the points without a position from the columns of a cloud (S57), if the columns are
    complete and of equal length.
    """
    found = [arrays[column] for column in cloud.columns if column in arrays]
    is_whole = len(found) == len(cloud.columns) and len({len(each) for each in found}) == 1
    if not is_whole or not cloud.axes:
        return
    is_there = ~np.isnan([arrays[axis] for axis in cloud.axes]).any(axis=0)
    if not is_there.all():
        for column in cloud.columns:
            arrays[column] = np.asarray(arrays[column], np.float64)[is_there].tolist()
