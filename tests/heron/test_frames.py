"""Heron as a host of rules with frames: the guard hears transforms, and the wheels send them."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from heron import messages
from heron.guard import InProcessGuard
from heron.messages import Message
from heron.robot.odometry import WheelOdometry, WheelOdometryParameters
from heron.scene.base import BaseParameters
from heron.topics import FRAMES, ODOMETRY, SCAN, InProcess, Topic
from support.guarding import Guarded

STATIC = Topic("/tf_static", FRAMES.type)
HAND = Topic("/hand", "geometry_msgs/PoseStamped")
MS = 1_000_000
RULES = """
system robot {
    frame base_link in odom timeout 0.3 sec;
    frame scanner in base_link;
    frame head in base_link at [0, 0, 1] m;
}
input scan = topic /scan : sensor_msgs/LaserScan .points up to 720 from scanner in odom
    timeout 1 sec;
input hand = topic /hand : geometry_msgs/PoseStamped .pose from base_link in odom timeout 9 sec;
zone kept_free in odom { box [4, 6, -1, 1] m; }
action note { log warning "note"; }
rule in_zone: if any(p in scan: p in kept_free) then { note; };
rule high: if hand.position.x > 2 m then { note; };
"""


def started(tmp_path: Path) -> tuple[Guarded, InProcessGuard]:
    path = tmp_path / "rules.ross"
    path.write_text(RULES)
    guarded = Guarded()
    return guarded, guarded.start(path)


def standing(tmp_path: Path) -> tuple[Guarded, InProcessGuard]:
    """A guard that has heard everything once, of a robot at the origin; no rule is active."""
    guarded, guard = started(tmp_path)
    for topic, message in (
        (STATIC, placed("scanner", "base_link", 0.5)),
        (FRAMES, placed("base_link", "odom", 0.0)),
        (HAND, hand(1.0)),
        (SCAN, scan(2.0)),
    ):
        guarded.publish(topic, message)
    return guarded, guard


def active_in(guard: InProcessGuard) -> tuple[str, ...]:
    """The rules that are active by now."""
    return guard.active


def frames(*found: Message) -> Message:
    """One message with the transforms of several."""
    return messages.message_class(FRAMES.type)([each.transforms[0] for each in found])


def placed(child: str, parent: str, x: float, yaw: float = 0.0) -> Message:
    return messages.transform_on_floor(0, parent, child, (x, 0.0, yaw))


def scan(ahead: float) -> Message:
    """A scan all around that meets something straight ahead."""
    ranges = np.full(360, np.inf, np.float32)
    ranges[180] = ahead
    angles = (-math.pi, -math.pi + 359 * math.radians(1), math.radians(1))
    return messages.laser_scan(0, angles, (0.1, 30.0), ranges)


def hand(x: float) -> Message:
    found = messages.new_message(HAND.type)
    found.header.frame_id, found.pose.position.x = "base_link", x
    return found


def test_points_and_poses_are_seen_through_the_transforms(tmp_path: Path) -> None:
    guarded, guard = started(tmp_path)
    guarded.publish(HAND, hand(1.0))
    guarded.publish(SCAN, scan(2.0))
    guarded.publish(STATIC, placed("scanner", "base_link", 0.5))
    assert active_in(guard) == ()  # not all inputs have come
    guarded.publish(FRAMES, placed("base_link", "odom", 0.0))
    assert active_in(guard) == ()
    guarded.now_ns += 100 * MS
    guarded.publish(
        FRAMES, frames(placed("wheel", "base_link", 9.0), placed("base_link", "odom", 2.0))
    )
    guarded.publish(SCAN, scan(2.0))  # at 4.5 m
    assert active_in(guard) == ("in_zone", "high")
    guarded.now_ns += 100 * MS
    guarded.publish(
        FRAMES, frames(placed("base_link", "odom", 2.0), placed("base_link", "odom", 0.5))
    )
    guarded.publish(SCAN, scan(2.0))
    assert active_in(guard) == ()
    guarded.publish(FRAMES, placed("base_link", "odom", 6.9, math.pi))  # it looks back
    guarded.publish(SCAN, scan(2.0))
    assert active_in(guard) == ("in_zone", "high")


def test_a_frame_that_falls_silent_is_stale(tmp_path: Path) -> None:
    guarded, guard = standing(tmp_path)
    guarded.now_ns += 299 * MS
    guard.tick(guarded.now_ns)
    assert active_in(guard) == ()
    guarded.publish(FRAMES, placed("arm", "odom", 0.0))
    guarded.now_ns += 3 * MS
    guard.tick(guarded.now_ns)
    assert active_in(guard) == ("in_zone", "high")


def test_a_frame_that_is_hung_elsewhere_is_stale(tmp_path: Path) -> None:
    """Also one that would stay for ever."""
    guarded, guard = standing(tmp_path)
    assert active_in(guard) == ()
    guarded.publish(STATIC, placed("scanner", "mast", 0.5))
    guarded.publish(SCAN, scan(2.0))
    assert active_in(guard) == ("in_zone",)
    guarded.publish(FRAMES, placed("base_link", "map", 0.0))
    assert active_in(guard) == ("in_zone", "high")
    guarded.publish(STATIC, placed("scanner", "base_link", 0.5))
    guarded.publish(FRAMES, placed("base_link", "odom", 0.0))
    guarded.publish(SCAN, scan(2.0))
    assert active_in(guard) == ()


@pytest.mark.parametrize("turn", [(0.0, 0.0, 0.0, 0.0), (0.0, 0.0, math.nan, 1.0)])
def test_a_turn_that_is_none_is_stale(tmp_path: Path, turn: tuple[float, ...]) -> None:
    guarded, guard = started(tmp_path)
    lying = placed("base_link", "odom", 0.0)
    lying.transforms[0].transform.rotation = messages.Quaternion(*turn)
    for topic, message in (
        (STATIC, placed("scanner", "base_link", 0.5)),
        (FRAMES, lying),
        (HAND, hand(1.0)),
        (SCAN, scan(2.0)),
    ):
        guarded.publish(topic, message)
    assert active_in(guard) == ("in_zone", "high")


def test_a_sector_is_taken_of_the_whole_scan(tmp_path: Path) -> None:
    """`topic /scan` and `topic /scan.ranges` are two ways to say so."""
    path = tmp_path / "rules.ross"
    path.write_text("""
    input whole = topic /scan : sensor_msgs/LaserScan timeout 1 sec;
    input ranges = topic /scan : sensor_msgs/LaserScan .ranges timeout 1 sec;
    action note { log warning "note"; }
    rule near: if min(whole.ranges[-30 deg .. 30 deg]) < 1 m then { note; };
    rule close: if min(ranges[-30 deg .. 30 deg]) < 0.5 m then { note; };
    """)
    guarded = Guarded()
    guard = guarded.start(path)
    for ahead, active in ((2.0, ()), (0.8, ("near",)), (0.4, ("near", "close")), (0.0, ())):
        guarded.publish(SCAN, scan(ahead))
        assert active_in(guard) == active


class Rolling:
    """A base whose wheels turn."""

    wheel_angles = (0.0, 0.0)


def test_the_wheels_tell_the_frame_of_the_base(tmp_path: Path) -> None:
    """It is the pose that the odometry says, and goes through the guard."""
    carrier, base = InProcess(), BaseParameters()
    reported: list[Message] = []
    placed_at: list[Message] = []
    carrier.subscribe(FRAMES, reported.append)
    carrier.subscribe(ODOMETRY, placed_at.append)
    physics, generator = Rolling(), np.random.default_rng(1)
    parameters = WheelOdometryParameters(latency=0.0)
    odometry = WheelOdometry(physics, carrier, generator, base, parameters)  # type: ignore[arg-type]
    for step in range(50):
        physics.wheel_angles = (0.1 * step, 0.15 * step)
        odometry.tick(step * odometry.period_ns)
    (last,), pose = reported[-1].transforms, placed_at[-1].pose.pose
    assert (last.header.frame_id, last.child_frame_id) == ("odom", "base_link")
    assert (last.transform.translation.x, last.transform.translation.y) == (
        pose.position.x,
        pose.position.y,
    )
    assert last.transform.rotation == pose.orientation
    assert math.hypot(pose.position.x, pose.position.y) > 0.3
    data = messages.store().serialize_ros1(reported[-1], "tf2_msgs/msg/TFMessage")
    assert messages.store().deserialize_ros1(data, "tf2_msgs/msg/TFMessage") == reported[-1]
