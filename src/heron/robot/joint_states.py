"""The joint states of the arm: angles from encoders, and torques from motor currents."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from heron import messages
from heron.robot.arm import Arm
from heron.robot.imperfection import Late
from heron.scene.arm import JOINTS
from heron.topics import JOINT_STATES, Carrier


@dataclass(frozen=True)
class JointStatesParameters:
    """Rate in Hz, latency in s, noise in Nm."""

    rate: float = 125.0
    latency: float = 0.008
    noise: float = 0.5


class JointStates:
    """Publishes the states of the joints."""

    def __init__(
        self,
        arm: Arm,
        carrier: Carrier,
        generator: np.random.Generator,
        parameters: JointStatesParameters,
    ) -> None:
        self._arm = arm
        self._generator = generator
        self._noise = parameters.noise
        self._names = list(JOINTS)
        self._late = Late(carrier.publisher(JOINT_STATES), round(parameters.latency * 1e9))
        self.period_ns = round(1e9 / parameters.rate)

    def tick(self, now_ns: int) -> None:
        """One period later."""
        arm = self._arm
        efforts = arm.torques + self._generator.normal(0.0, self._noise, len(self._names))
        state = messages.joint_state(arm.elapsed_ns, self._names, arm.angles, arm.speeds, efforts)
        self._late.send(now_ns, state)
        self._late.deliver(now_ns)
