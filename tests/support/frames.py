"""Frames: transforms as messages of recordings, and turns worked out by matrices."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from rosbags.typesys import get_types_from_msg
from rosbags.typesys.store import Typestore

from support.recordings import stamped

TYPE = "tf2_msgs/msg/TFMessage"
Matrix = NDArray[np.float64]


class Placed(NamedTuple):
    """A frame in its parent: where its origin is, and how it is turned, by x, y, z and w."""

    parent: str
    child: str
    origin: Sequence[float]
    turn: Sequence[float]


def rotation(turn: Sequence[float]) -> Matrix:
    """The matrix of a turn by a quaternion of any length, as I + 2w[v] + 2[v][v]."""
    x, y, z, w = np.array(turn) / np.linalg.norm(turn)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    found: Matrix = np.eye(3) + 2.0 * w * cross + 2.0 * cross @ cross
    return found


def matrix(placed: Placed) -> Matrix:
    """The matrix that leads from coordinates of the frame to those of its parent."""
    found = np.eye(4)
    found[:3, :3] = rotation(placed.turn)
    found[:3, 3] = placed.origin
    return found


def turn_of(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    """The quaternion of turns about the fixed axes x, y and z, in rad, one after the other."""
    x, y, z, w = 0.0, 0.0, 0.0, 1.0
    for angle, axis in ((roll, 0), (pitch, 1), (yaw, 2)):
        sine, cosine = float(np.sin(angle / 2.0)), float(np.cos(angle / 2.0))
        by = [sine if each == axis else 0.0 for each in range(3)]
        x, y, z, w = (
            cosine * x + by[0] * w + by[1] * z - by[2] * y,
            cosine * y + by[1] * w + by[2] * x - by[0] * z,
            cosine * z + by[2] * w + by[0] * y - by[1] * x,
            cosine * w - by[0] * x - by[1] * y - by[2] * z,
        )
    return x, y, z, w


def transforms(ros: Typestore, index: int, *placed: Placed) -> tuple[str, Any]:
    """A message with transforms."""
    if TYPE not in ros.types:
        ros.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms\n", TYPE))
    types = ros.types
    found = []
    for each in placed:
        header = stamped(ros, index)
        header.frame_id = each.parent
        (x, y, z), turn = each.origin, dict(zip("xyzw", each.turn, strict=True))
        transform = types["geometry_msgs/msg/Transform"](
            translation=types["geometry_msgs/msg/Vector3"](x=x, y=y, z=z),
            rotation=types["geometry_msgs/msg/Quaternion"](**turn),
        )
        stamped_transform = types["geometry_msgs/msg/TransformStamped"]
        found.append(
            stamped_transform(header=header, child_frame_id=each.child, transform=transform)
        )
    return TYPE, types[TYPE](transforms=found)


def pose(
    ros: Typestore, index: int, frame: str, place: Sequence[float], turn: Sequence[float]
) -> tuple[str, Any]:
    """A pose in a frame."""
    types, name = ros.types, "geometry_msgs/msg/PoseStamped"
    header = stamped(ros, index)
    header.frame_id = frame
    return name, types[name](
        header=header,
        pose=types["geometry_msgs/msg/Pose"](
            position=types["geometry_msgs/msg/Point"](**dict(zip("xyz", place, strict=True))),
            orientation=types["geometry_msgs/msg/Quaternion"](
                **dict(zip("xyzw", turn, strict=True))
            ),
        ),
    )
