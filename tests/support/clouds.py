"""Clouds of random layouts, with the numbers that were written into them, and clouds that lie."""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from random import Random
from types import SimpleNamespace
from typing import Any

import numpy as np
from rosbags.typesys.store import Typestore

from support.recordings import stamped

FORMATS = {1: "b", 2: "B", 3: "h", 4: "H", 5: "i", 6: "I", 7: "f", 8: "d"}
"""The formats of `struct`, by the `datatype` of a field."""

READ = ("x", "intensity", "z")
"""The fields that tests read."""

MOST = 9

_SPECIAL = (math.nan, math.inf, -math.inf, 0.0, -0.0, 1e-3)


@dataclass(frozen=True)
class Made:
    """A cloud, and the numbers of all its points, those without a place included, by field."""

    cloud: SimpleNamespace
    numbers: Mapping[str, Sequence[float]]

    def expected(self, names: Sequence[str] = READ, most: int = MOST) -> list[list[float]] | None:
        """The columns that S56 and S57 give; None if the cloud is not known."""
        if any(name not in self.numbers for name in names):
            return None
        count = self.cloud.height * self.cloud.width
        axes = [self.numbers[axis] for axis in "xyz" if axis in self.numbers]
        there = [i for i in range(count) if not any(math.isnan(axis[i]) for axis in axes)]
        if count > most:
            return None
        return [[self.numbers[name][i] for i in there] for name in names]


def random_cloud(random: Random) -> Made:
    """A cloud of any layout; a few do not have all that is read, or too many points."""
    names = ["x", "y", "z", "intensity", *random.sample(["ring", "t", "rgb"], random.randrange(3))]
    if random.random() < 0.1:
        names.remove(random.choice(names))
    random.shuffle(names)
    order = ">" if random.random() < 0.5 else "<"
    fields, offset = [], random.randrange(3)
    for name in names:
        datatype = random.choice([7, 7, 8, *FORMATS])
        count = random.choice([0, 1])
        fields.append(_field(name, offset, datatype, count))
        offset += struct.calcsize("=" + FORMATS[datatype]) + random.choice([0, 0, 1, 3])
    rows, columns = random.choice([(1, random.randrange(8)), (random.randrange(5), 3)])
    point_step = offset + random.randrange(3)
    row_step = columns * point_step + random.randrange(5)
    if rows <= 1 and random.random() < 0.3:
        row_step = random.choice([0, 2**32 - 1])  # there is no other row
    data = bytearray(random.randbytes(max(rows, 1) * columns * (point_step + 4) + 4))
    numbers: dict[str, list[float]] = {name: [] for name in names}
    for row in range(rows):
        for column in range(columns):
            start = row * row_step + column * point_step
            for field in fields:
                form = order + FORMATS[field.datatype]
                struct.pack_into(form, data, start + field.offset, _number(random, field.datatype))
                (read,) = struct.unpack_from(form, data, start + field.offset)
                numbers[field.name].append(float(read))
    needed = (rows - 1) * row_step + columns * point_step if rows and columns else 0
    del data[needed + random.randrange(3) :]
    cloud = SimpleNamespace(
        height=rows,
        width=columns,
        fields=fields,
        is_bigendian=order == ">",
        point_step=point_step,
        row_step=row_step,
        data=bytes(data),
        is_dense=False,
    )
    return Made(cloud, numbers)


def plain_cloud(
    points: Sequence[Mapping[str, float]], names: Sequence[str] = ("x", "y", "z")
) -> SimpleNamespace:
    """A cloud of floats, as most drivers send them; fields that a point lacks are 0."""
    numbers = [point.get(name, 0.0) for point in points for name in names]
    step = 4 * len(names)
    return SimpleNamespace(
        height=1,
        width=len(points),
        fields=[_field(name, 4 * index, 7, 1) for index, name in enumerate(names)],
        is_bigendian=False,
        point_step=step,
        row_step=step * len(points),
        data=struct.pack(f"<{len(numbers)}f", *numbers),
        is_dense=False,
    )


def as_json(cloud: SimpleNamespace) -> dict[str, Any]:
    """A cloud as robots of live tests take it."""
    fields = [vars(field) for field in cloud.fields]
    return {**vars(cloud), "fields": fields, "data": cloud.data.hex()}


def _field(name: str, offset: int, datatype: int, count: int) -> SimpleNamespace:
    return SimpleNamespace(name=name, offset=offset, datatype=datatype, count=count)


def _number(random: Random, datatype: int) -> float | int:
    if datatype >= 7:
        return random.choice([*_SPECIAL, random.uniform(-9.0, 9.0)])
    bits = 8 * struct.calcsize("=" + FORMATS[datatype])
    low = -(2 ** (bits - 1)) if datatype % 2 else 0
    return random.randint(low, low + 2**bits - 1)


def message(ros: Typestore, index: int, cloud: SimpleNamespace) -> Any:
    """The cloud as a message of rosbags."""
    kind = ros.types["sensor_msgs/msg/PointField"]
    return ros.types["sensor_msgs/msg/PointCloud2"](
        header=stamped(ros, index),
        height=cloud.height,
        width=cloud.width,
        fields=[kind(**vars(field)) for field in cloud.fields],
        is_bigendian=cloud.is_bigendian,
        point_step=cloud.point_step,
        row_step=cloud.row_step,
        data=np.frombuffer(cloud.data, np.uint8),
        is_dense=cloud.is_dense,
    )


# --- clouds that lie -------------------------------------------------------------------------


def _set(**changes: Any) -> Callable[[SimpleNamespace], None]:
    return lambda cloud: vars(cloud).update(changes)


def _set_field(index: int, **changes: Any) -> Callable[[SimpleNamespace], None]:
    return lambda cloud: vars(cloud.fields[index]).update(changes)


HUGE = 2**32 - 1

LIES: Mapping[str, Callable[[SimpleNamespace], None]] = {
    "no step": _set(point_step=0),
    "a huge step": _set(point_step=HUGE),
    "a huge row": _set(row_step=HUGE),
    "rows that overlap": _set(row_step=1),
    "too wide": _set(width=HUGE),
    "too high": _set(height=HUGE),
    "too many points": _set(width=HUGE, height=HUGE),
    "too many for 64 bits": _set(width=HUGE, height=HUGE, point_step=HUGE, row_step=HUGE),
    "no bytes": _set(data=b""),
    "a byte too few": lambda cloud: vars(cloud).update(data=cloud.data[:-1]),
    "an offset behind the point": _set_field(0, offset=13),
    "a huge offset": _set_field(0, offset=HUGE),
    "an offset that overflows": _set_field(0, offset=HUGE - 3),
    "no type": _set_field(0, datatype=0),
    "a type that is none": _set_field(0, datatype=9),
    "several numbers": _set_field(0, count=3),
    "a huge count": _set_field(0, count=HUGE),
    "another name": _set_field(0, name="X"),
    "a name twice": _set_field(1, name="x"),
    "a number twice": _set_field(1, name="intensity"),
    "a place twice": _set_field(3, name="y"),
    "a place that is not read and lies outside": _set_field(1, offset=HUGE),
    "no fields": _set(fields=[]),
}
"""Changes to `truthful()` after each of which nothing is known of its points."""


def truthful() -> SimpleNamespace:
    """Two rows of two points, of which x, intensity and z are read."""
    points = [{"x": 1.0}, {"x": 2.0}, {"x": 3.0}, {"x": 4.0}]
    cloud = plain_cloud(points, ("x", "y", "z", "intensity"))
    cloud.height, cloud.width, cloud.row_step = 2, 2, 2 * cloud.point_step
    return cloud
