"""Safety rules of the rover. The task sheet has the requirements S1 to S4."""

from __future__ import annotations

import math

from messages import Imu, Odometry, Range
from timers import Lasting, Rule

IMU_TIMEOUT = 0.2
ODOMETRY_TIMEOUT = 0.5
FRONT_TIMEOUT = 0.5

LEVEL = (math.radians(-10), math.radians(10))
BRISK = 0.3
FASTEST = 0.8
NEAR = 0.5

CREEP = (-0.2, 0.2)


class Guard:
    """Keeps the latest messages and changes commands."""

    def __init__(self) -> None:
        self.pitch, self.pitch_at = 0.0, -math.inf
        self.speed, self.speed_at = 0.0, -math.inf
        self.distance, self.distance_at = 0.0, -math.inf
        self.steep = Lasting(1.0)
        self.overspeed = Lasting(0.5)
        self.slow_on_slope = Rule(2.0)
        self.slow_overspeed = Rule(1.0)
        self.stop_near = Rule(1.0)

    def on_imu(self, now: float, message: Imu) -> None:
        self.pitch, self.pitch_at = message.orientation.pitch(), now

    def on_odometry(self, now: float, message: Odometry) -> None:
        self.speed, self.speed_at = message.twist.twist.linear.x, now

    def on_front(self, now: float, message: Range) -> None:
        self.distance, self.distance_at = message.range, now

    def command(self, now: float, wanted: float) -> float:
        """The speed in m/s that the rules permit in the place of the wanted one."""
        no_pitch = now - self.pitch_at > IMU_TIMEOUT or math.isnan(self.pitch)
        no_speed = now - self.speed_at > ODOMETRY_TIMEOUT or math.isnan(self.speed)
        no_distance = math.isnan(self.distance)
        no_distance = no_distance or now - self.distance_at > FRONT_TIMEOUT

        steep = self.steep.update(now, not LEVEL[0] <= self.pitch <= LEVEL[1])
        fast = self.speed > BRISK
        overspeed = self.overspeed.update(now, self.speed > FASTEST)
        near = self.distance < NEAR

        # S1
        on_slope = no_pitch or no_speed or (steep and fast)
        slow_on_slope = self.slow_on_slope.update(now, on_slope)
        # S2
        slow_overspeed = self.slow_overspeed.update(now, no_speed or overspeed)
        # S3
        stop_near = self.stop_near.update(now, no_distance or near)

        if stop_near:
            return 0.0
        if slow_on_slope or slow_overspeed:
            return max(CREEP[0], min(CREEP[1], wanted))
        return wanted
