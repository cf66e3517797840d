"""The settings that all experiments share and that studies vary."""

from __future__ import annotations

from dataclasses import dataclass

from heron.scene import BaseParameters


@dataclass(frozen=True)
class Settings:
    """Torques in Nm, times in s."""

    usual_torque: float = BaseParameters().torque
    """The default torque limit of the servo on a drive wheel (Nm), unless a command raises it."""
    operator_delay: float = 30.0
    """The time from a permanent stop to the arrival of the operator."""


USUAL = Settings()
