"""Transforms between frames, as /tf and /tf_static carry them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rosbags.typesys.store import Typestore

from support.made_messages import made
from support.simulated.base import Now, turned
from support.simulated.recording import header, rounded


@dataclass(frozen=True)
class Frame:
    """A frame in another: where it is (m), and how it is turned (rad)."""

    name: str
    parent: str
    place: tuple[float, float, float] = (0.0, 0.0, 0.0)
    turn: tuple[float, float, float] = (0.0, 0.0, 0.0)


def transforms(store: Typestore, t: float, *frames: Frame) -> dict[str, Any]:
    """The fields of a tf2_msgs/TFMessage."""
    return {"transforms": [_transform(store, t, frame) for frame in frames]}


def of_odometry(now: Now) -> Frame:
    """A base in the frame of its odometry."""
    return Frame("base_link", "odom", (now.x, now.y, 0.0), (0.0, 0.0, now.yaw))


def _transform(store: Typestore, t: float, frame: Frame) -> Any:
    places = zip("xyz", map(rounded, frame.place, [14] * 3), strict=True)
    return made(
        store,
        "geometry_msgs/TransformStamped",
        **header(round(t * 1e9), frame.parent),
        child_frame_id=frame.name,
        **{f"transform__translation__{axis}": value for axis, value in places},
        **turned("transform__rotation", *frame.turn),
    )
