"""The operator of the base.

The operator drives the robot by hand, at walking pace and with full torque, over the obstacle that
stopped it, or back from a hazard. Then the operator resets the rules: one visit per stop. Without
the manual drive, the same rule would stop the robot again after the reset.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from heron import messages
from heron.experiments.summons import Summons
from heron.guard import Guard
from heron.robot import Base
from heron.robot.physics import attitude
from heron.scene import Course
from heron.topics import JOYSTICK, REPLAN, Carrier

_LEVEL = math.radians(3)
_TOO_STEEP = math.radians(20)


@dataclass(frozen=True)
class BaseOperatorParameters:
    """Lengths in m, speeds in m/s, times in s."""

    delay: float
    """The time from a call to the arrival of the operator."""
    pace: float = 0.2
    distance: float = 1.2
    """The shortest distance that the operator drives: the robot is 0.9 m long, and must pass a bump
    completely.
    """


class BaseOperator:
    """The operator stands next to the robot and sees the robot directly."""

    period_ns = 100_000_000

    def __init__(
        self,
        physics: Base,
        carrier: Carrier,
        guard: Guard,
        course: Course,
        parameters: BaseOperatorParameters,
    ) -> None:
        self._physics = physics
        self.summons = Summons(guard, parameters.delay)
        self._course = course
        self._parameters = parameters
        self._drive = carrier.publisher(JOYSTICK)
        self._replan = carrier.publisher(REPLAN)
        self._by_hand: Callable[[], bool] | None = None

    def tick(self, now_ns: int) -> None:
        """Look after the robot."""
        if self.summons.presence_ns(now_ns) is None:
            return
        self._by_hand = self._by_hand or self._way_out()
        if not self._by_hand():
            self._drive(messages.twist(0.0, 0.0))
            self.summons.reset()
            self._by_hand = None

    def _way_out(self) -> Callable[[], bool]:
        """Choose the path of the operator. The returned function returns True while the operator
        drives.
        """
        start = self._physics.position.copy()
        is_too_steep = self._is_before_steep_ramp()
        pace = -self._parameters.pace if is_too_steep else self._parameters.pace
        if is_too_steep:
            self._replan(messages.Bool(True))

        def drive() -> bool:
            distance = math.dist(start[:2], self._physics.position[:2])
            if distance >= self._parameters.distance and abs(self._pitch()) < _LEVEL:
                return False
            self._drive(messages.twist(pace, 0.0))
            return True

        return drive

    def _is_before_steep_ramp(self) -> bool:
        """Return True if the robot is on, or directly in front of, a ramp that is too steep to
        drive.
        """
        x, y, _ = self._physics.position
        return any(
            slope.start_x - 1.0 < x < slope.end_x
            and abs(y - slope.y) < 1.0
            and slope.angle > _TOO_STEEP
            for slope in self._course.slopes
        )

    def _pitch(self) -> float:
        return attitude(self._physics.quaternion).pitch
