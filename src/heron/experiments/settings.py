"""What an experiment takes for granted, and a study varies."""

from __future__ import annotations

from dataclasses import dataclass

from heron.scene import BaseParameters


@dataclass(frozen=True)
class Settings:
    """Torques in Nm, times in s."""

    usual_torque: float = BaseParameters().torque
    """What the servo of a drive wheel gives at most, unless it is told to give more."""
    operator_delay: float = 30.0
    """From when rules have stopped the robot for good until an operator is there."""


USUAL = Settings()
