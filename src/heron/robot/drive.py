"""The drive, which turns velocity commands into wheel commands.

It follows commands with limited acceleration, and stops if commands are missing. The joystick has
precedence over programs, and full torque.
"""

from __future__ import annotations

from dataclasses import dataclass

from heron.messages import Message
from heron.robot.base import Base
from heron.scene.base import BaseParameters
from heron.topics import BOOST, COMMAND, JOYSTICK, Carrier

_NEVER = -(10**18)


@dataclass(frozen=True)
class DriveParameters:
    """Rate in Hz, times in s, accelerations in m/s^2 and rad/s^2; the speeds are the speeds of a
    MiR100.
    """

    rate: float = 50.0
    command_timeout: float = 0.5
    boost_timeout: float = 0.25
    acceleration: float = 0.5
    braking: float = 1.0
    turning: float = 1.5
    fastest_forward: float = 1.5
    fastest_backward: float = 0.3


@dataclass
class _Heard:
    """The last command from one side."""

    linear: float = 0.0
    angular: float = 0.0
    at_ns: int = _NEVER


class DifferentialDrive:
    """Differential drive of two wheels."""

    def __init__(
        self,
        physics: Base,
        carrier: Carrier,
        base: BaseParameters,
        parameters: DriveParameters,
    ) -> None:
        self._physics = physics
        self._base = base
        self._parameters = parameters
        self.period_ns = round(1e9 / parameters.rate)
        self._program, self._joystick = _Heard(), _Heard()
        self._boosted_ns = _NEVER
        self._linear = self._angular = 0.0
        carrier.subscribe(COMMAND, lambda message: self._hear(self._program, message))
        carrier.subscribe(JOYSTICK, lambda message: self._hear(self._joystick, message))
        carrier.subscribe(BOOST, self._boost)

    def tick(self, now_ns: int) -> None:
        """One period later."""
        found, base = self._parameters, self._base
        is_by_hand = self._is_fresh(self._joystick, now_ns)
        linear, angular = self._wanted(self._joystick if is_by_hand else self._program, now_ns)
        step_s = self.period_ns * 1e-9
        is_braking = abs(linear) < abs(self._linear) or linear * self._linear < 0
        most = found.braking if is_braking else found.acceleration
        self._linear = _towards(self._linear, linear, most * step_s)
        self._angular = _towards(self._angular, angular, found.turning * step_s)
        half = self._angular * base.half_track
        self._physics.turn_wheels(
            (self._linear - half) / base.wheel_radius, (self._linear + half) / base.wheel_radius
        )
        is_boosted = is_by_hand or now_ns - self._boosted_ns <= found.boost_timeout * 1e9
        self._physics.limit_torque(base.boosted_torque if is_boosted else base.torque)

    def _wanted(self, heard: _Heard, now_ns: int) -> tuple[float, float]:
        if not self._is_fresh(heard, now_ns):
            return 0.0, 0.0
        found = self._parameters
        return max(-found.fastest_backward, min(found.fastest_forward, heard.linear)), heard.angular

    def _is_fresh(self, heard: _Heard, now_ns: int) -> bool:
        return now_ns - heard.at_ns <= self._parameters.command_timeout * 1e9

    def _hear(self, heard: _Heard, message: Message) -> None:
        heard.linear, heard.angular = message.linear.x, message.angular.z
        heard.at_ns = self._physics.now_ns

    def _boost(self, message: Message) -> None:
        self._boosted_ns = self._physics.now_ns if message.data else _NEVER


def _towards(value: float, wanted: float, most: float) -> float:
    return value + max(-most, min(most, wanted - value))
