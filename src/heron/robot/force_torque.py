"""The force-torque sensor at the wrist."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from heron import messages
from heron.robot.arm import Arm
from heron.robot.imperfection import Late, LowPass
from heron.scene.scene import STEP_NS
from heron.topics import WRENCH, Carrier


@dataclass(frozen=True)
class ForceTorqueParameters:
    """Rate in Hz, times in s, forces in N. The latency is the latency of a controller on another
    computer: one period for the reading, and one period for the command that depends on it.
    """

    rate: float = 125.0
    latency: float = 0.016
    bandwidth: float = 40.0
    noise: float = 0.3
    bias: float = 0.2
    """The error that is left after zeroing."""


class ForceTorque:
    """Publishes the force on the hand, without the weight of the hand: the sensor was zeroed with
    the block in the hand.
    """

    period_ns = STEP_NS

    def __init__(
        self,
        arm: Arm,
        carrier: Carrier,
        generator: np.random.Generator,
        parameters: ForceTorqueParameters,
    ) -> None:
        self._arm = arm
        self._generator = generator
        self._noise = parameters.noise
        self._low_pass = LowPass(parameters.bandwidth, STEP_NS)
        self._late = Late(carrier.publisher(WRENCH), round(parameters.latency * 1e9))
        self._weight = arm.force() + generator.normal(0.0, parameters.bias, 3)
        self._steps = round(1e9 / parameters.rate / STEP_NS)

    def tick(self, now_ns: int) -> None:
        """One step later."""
        seen = self._low_pass.feed(self._arm.force() - self._weight)
        if now_ns // STEP_NS % self._steps == 0:
            force = seen + self._generator.normal(0.0, self._noise, 3)
            self._late.send(now_ns, messages.wrench(now_ns, tuple(force.tolist())))
        self._late.deliver(now_ns)
