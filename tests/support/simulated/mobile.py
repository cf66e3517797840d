"""The topics that all bases have: where they are, how fast, and what they are reported."""

from __future__ import annotations

from collections.abc import Sequence

from rosbags.typesys.store import Typestore

from support.simulated.base import Base, command, odometry
from support.simulated.frames import Frame, of_odometry, transforms
from support.simulated.recording import Sensor, every


def driving(
    store: Typestore,
    base: Base,
    frames: Sequence[Frame],
    rate: float,
    odometry_topic: str = "/odom",
    command_topic: str = "/cmd_vel",
    silent: Sequence[tuple[float, float]] = (),
) -> Sequence[Sensor]:
    """Its frames, its odometry at a rate (Hz), and its commands, for as long as it drives. In the
    stretches `silent` the odometry does not come.
    """
    seconds, tree = base.legs[-1].until, "tf2_msgs/TFMessage"
    return [
        Sensor("/tf_static", tree, [0.0], lambda t: transforms(store, t, *frames)),
        Sensor(
            "/tf",
            tree,
            every(rate, seconds),
            lambda t: transforms(store, t, of_odometry(base.at(t))),
        ),
        Sensor(
            odometry_topic,
            "nav_msgs/Odometry",
            every(rate, seconds),
            lambda t: odometry(base.at(t)),
            "odom",
            silent,
        ),
        Sensor(
            command_topic,
            "geometry_msgs/Twist",
            every(20, seconds),
            lambda t: command(base.wanted(t)),
        ),
    ]
