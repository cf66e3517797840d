"""Write the recording of the demo: a small vehicle drives down a corridor, 75 s.

The vehicle crosses a bump, climbs a ramp, and stops hard for a person. Its IMU falls silent for a
while, and its satellite receiver goes stale. The recording is a bag directory with an .mcap file,
in the format of a robot with ROS 2. Every run writes the same recording.

    python examples/demo/record.py build/demo
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

SEED = 2025
DURATION = 75.0  # s
STEP = 0.002  # s, of the simulation
GRAVITY = 9.81  # m/s^2
START_NS = 1_750_000_000_000_000_000

CRUISE = 0.8  # m/s
BUMP_START, BUMP_LENGTH, BUMP_HEIGHT = 8.0, 0.5, 0.05  # m along the path
RAMP_START, RAMP_END, RAMP_RISE = 18.0, 24.0, np.radians(12.0)
TRACK = 0.5  # m between the axles: the bump is felt over this length
SUSPENSION_FREQUENCY, SUSPENSION_DAMPING = 9.0, 0.12  # rad/s, of 1
PERSON_ARRIVES, PERSON_LEAVES = 48.0, 54.0  # s
IMU_SILENT = (58.0, 59.5)  # s
FIX_STALE = (62.0, 70.0)  # s
CORRIDOR = 1.6  # m from the middle to each wall
BEAMS = np.linspace(-np.pi / 2, np.pi / 2, 37)  # rad; 0 is straight ahead

TYPES = get_typestore(Stores.ROS2_JAZZY)


def message(name: str, **fields: Any) -> Any:
    """A message of type `name`, as in `sensor_msgs/Imu`."""
    return TYPES.types[name.replace("/", "/msg/")](**fields)


# --- the vehicle -----------------------------------------------------------------------------


def terrain_slope(distance: float) -> float:
    """The slope of the ground under the vehicle (rad, up is positive)."""
    slope = RAMP_RISE * np.clip((distance - RAMP_START) / TRACK, 0, 1)
    slope -= RAMP_RISE * np.clip((distance - RAMP_END) / TRACK, 0, 1)
    front, rear = (bump_height(distance + side * TRACK / 2) for side in (1, -1))
    return float(slope + (front - rear) / TRACK)


def bump_height(distance: float) -> float:
    """The height of the bump at a place (m)."""
    along = (distance - BUMP_START) / BUMP_LENGTH
    return float(BUMP_HEIGHT * np.sin(np.pi * along) ** 2) if 0 < along < 1 else 0.0


def simulate() -> dict[str, np.ndarray]:
    """The motion of the vehicle, one value per step. The vehicle drives at a set speed, turns to
    and fro, and pitches on its springs (positive pitch is nose down, as in REP 103).
    """
    times = np.arange(0.0, DURATION, STEP)
    names = ("distance", "speed", "acceleration", "pitch", "pitch_rate", "yaw", "yaw_rate")
    track = {name: np.zeros(len(times)) for name in names}
    distance = speed = pitch = pitch_rate = yaw = 0.0
    for i, t in enumerate(times):
        is_blocked = PERSON_ARRIVES + 0.8 < t < PERSON_LEAVES
        limit = 3.0 if is_blocked else 0.6  # m/s^2: the vehicle brakes harder than it starts
        acceleration = float(
            np.clip(((0.0 if is_blocked else CRUISE) - speed) / 0.1, -limit, limit)
        )
        yaw_rate = 0.25 * np.sin(2 * np.pi * t / 15.0) * speed / CRUISE
        error = -terrain_slope(distance) - pitch
        pitch_rate += (
            SUSPENSION_FREQUENCY**2 * error
            - 2 * SUSPENSION_DAMPING * SUSPENSION_FREQUENCY * pitch_rate
        ) * STEP
        pitch += pitch_rate * STEP
        speed += acceleration * STEP
        distance += speed * STEP
        yaw += yaw_rate * STEP
        for name, value in zip(
            names, (distance, speed, acceleration, pitch, pitch_rate, yaw, yaw_rate), strict=True
        ):
            track[name][i] = value
    return {"time": times, **track}


# --- its sensors -----------------------------------------------------------------------------


def header(t: float, frame: str) -> Any:
    """A header with the stamp of an instant (s into the recording)."""
    seconds, nanoseconds = divmod(stamp_ns(t), 1_000_000_000)
    stamp = message("builtin_interfaces/Time", sec=seconds, nanosec=nanoseconds)
    return message("std_msgs/Header", stamp=stamp, frame_id=frame)


def stamp_ns(t: float) -> int:
    """An instant on the clock of the recording."""
    return START_NS + round(t * 1e9)


def vector(x: float, y: float, z: float) -> Any:
    """A geometry_msgs/Vector3."""
    return message("geometry_msgs/Vector3", x=x, y=y, z=z)


def orientation(pitch: float, yaw: float) -> Any:
    """The quaternion of a yaw followed by a pitch."""
    cp, sp, cy, sy = np.cos(pitch / 2), np.sin(pitch / 2), np.cos(yaw / 2), np.sin(yaw / 2)
    return message("geometry_msgs/Quaternion", x=-sp * sy, y=sp * cy, z=cp * sy, w=cp * cy)


def imu(t: float, now: dict[str, float], noise: np.random.Generator) -> Any:
    """sensor_msgs/Imu: an accelerometer measures acceleration minus gravity."""
    jolt = 12.0 * now["pitch_rate"] * now["speed"]  # the axles are pushed up and down
    felt = vector(
        now["acceleration"] - GRAVITY * np.sin(now["pitch"]) + noise.normal(0, 0.15),
        now["speed"] * now["yaw_rate"] + noise.normal(0, 0.15),
        GRAVITY * np.cos(now["pitch"]) - jolt + noise.normal(0, 0.25),
    )
    rates = vector(
        noise.normal(0, 0.01),
        now["pitch_rate"] + noise.normal(0, 0.01),
        now["yaw_rate"] + noise.normal(0, 0.01),
    )
    return message(
        "sensor_msgs/Imu",
        header=header(t, "imu_link"),
        orientation=orientation(now["pitch"] + noise.normal(0, 0.002), now["yaw"]),
        orientation_covariance=np.diag([4e-6] * 3).ravel(),
        angular_velocity=rates,
        angular_velocity_covariance=np.diag([1e-4] * 3).ravel(),
        linear_acceleration=felt,
        linear_acceleration_covariance=np.diag([0.02] * 3).ravel(),
    )


def odometry(t: float, now: dict[str, float], noise: np.random.Generator) -> Any:
    """nav_msgs/Odometry from the wheels."""
    twist = message(
        "geometry_msgs/Twist",
        linear=vector(now["speed"] + noise.normal(0, 0.005), 0.0, 0.0),
        angular=vector(0.0, 0.0, now["yaw_rate"] + noise.normal(0, 0.005)),
    )
    pose = message(
        "geometry_msgs/Pose",
        position=message("geometry_msgs/Point", x=now["distance"], y=0.0, z=0.0),
        orientation=orientation(0.0, now["yaw"]),
    )
    covariance = np.zeros(36)
    return message(
        "nav_msgs/Odometry",
        header=header(t, "odom"),
        child_frame_id="base_link",
        pose=message("geometry_msgs/PoseWithCovariance", pose=pose, covariance=covariance),
        twist=message("geometry_msgs/TwistWithCovariance", twist=twist, covariance=covariance),
    )


def scan(t: float, now: dict[str, float], noise: np.random.Generator) -> Any:
    """sensor_msgs/LaserScan: the walls, and the person who stands on the path for a while."""
    with np.errstate(divide="ignore"):
        walls = CORRIDOR / np.abs(np.sin(BEAMS + now["yaw"]))
    ranges = np.where(walls < 10.0, walls + noise.normal(0, 0.01, len(BEAMS)), np.inf)
    if PERSON_ARRIVES < t < PERSON_LEAVES:
        coming = 1.5 - 1.2 * np.sin(np.pi * (t - PERSON_ARRIVES) / (PERSON_LEAVES - PERSON_ARRIVES))
        ranges = np.where(np.abs(BEAMS) < 0.15, coming + noise.normal(0, 0.01), ranges)
    return message(
        "sensor_msgs/LaserScan",
        header=header(t, "laser"),
        angle_min=BEAMS[0],
        angle_max=BEAMS[-1],
        angle_increment=BEAMS[1] - BEAMS[0],
        time_increment=0.0,
        scan_time=0.1,
        range_min=0.05,
        range_max=10.0,
        ranges=ranges.astype(np.float32),
        intensities=np.zeros(0, dtype=np.float32),
    )


def fix(t: float, now: dict[str, float], noise: np.random.Generator) -> Any:
    """sensor_msgs/NavSatFix."""
    return message(
        "sensor_msgs/NavSatFix",
        header=header(t, "gps"),
        status=message("sensor_msgs/NavSatStatus", status=0, service=1),
        latitude=55.7105 + now["distance"] / 111_320 + noise.normal(0, 3e-6),
        longitude=13.2100 + noise.normal(0, 5e-6),
        altitude=78.0 + noise.normal(0, 0.8),
        position_covariance=np.diag([0.1, 0.1, 0.6]).ravel(),
        position_covariance_type=2,
    )


SENSORS = (
    # topic, message type, rate in Hz, reading, and when it falls silent (s)
    ("/scan", "sensor_msgs/msg/LaserScan", 10.0, scan, (0.0, 0.0)),
    ("/imu/data", "sensor_msgs/msg/Imu", 50.0, imu, IMU_SILENT),
    ("/odom", "nav_msgs/msg/Odometry", 20.0, odometry, (0.0, 0.0)),
    ("/fix", "sensor_msgs/msg/NavSatFix", 1.0, fix, FIX_STALE),
)


def readings(noise: np.random.Generator) -> Iterator[tuple[str, int, Any]]:
    """Return topic, stamp and message of every reading, in the order of time."""
    track = simulate()
    due = [
        (number / rate + 0.003 * index, index)
        for index, (_, _, rate, _, _) in enumerate(SENSORS)
        for number in range(int(DURATION * rate))
    ]
    for t, index in sorted(due):
        topic, _, _, read, (silent_from, silent_to) = SENSORS[index]
        if not silent_from <= t < silent_to:
            step = min(round(t / STEP), len(track["time"]) - 1)
            now = {name: float(values[step]) for name, values in track.items()}
            yield topic, stamp_ns(t), read(t, now, noise)


def write(folder: Path) -> Path:
    """Write the recording into `folder`, and return the path of the .mcap file.

    Other files in the folder stay.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory(dir=folder) as scratch:
        bag = Path(scratch) / folder.name
        _write_bag(bag)
        for file in bag.iterdir():
            file.replace(folder / file.name)
    return folder / f"{folder.name}.mcap"


def _write_bag(folder: Path) -> None:
    with Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connections = {
            topic: writer.add_connection(topic, message_type, typestore=TYPES)
            for topic, message_type, *_ in SENSORS
        }
        for topic, at_ns, reading in readings(np.random.default_rng(SEED)):
            connection = connections[topic]
            writer.write(connection, at_ns, TYPES.serialize_cdr(reading, connection.msgtype))


if __name__ == "__main__":
    parser = ArgumentParser(description="Write the recording of the demo.")
    parser.add_argument(
        "folder", type=Path, nargs="?", default=Path("build/demo"), help="output folder"
    )
    sys.stdout.write(f"{write(parser.parse_args().folder)}\n")
