"""The settings that all experiments share and that studies vary."""

from __future__ import annotations

from dataclasses import dataclass

from heron.scene import BaseParameters


@dataclass(frozen=True)
class Settings:
    """Torques in Nm, times in s."""

    usual_torque: float = BaseParameters().torque
    """The most that the servo of a drive wheel gives, unless it is told to give more."""
    operator_delay: float = 30.0
    """The time from a stop for good until an operator is there."""


USUAL = Settings()
