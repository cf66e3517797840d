"""Settings of Nav2's collision monitor for the base of the course: its zones and their actions.

Names and defaults are the names and defaults of the parameters in Jazzy.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from course_scenes import BRAKING, HALF_LENGTH, HALF_WIDTH, SPEED

Parameter = bool | float | int | str | list[str]


@dataclass(frozen=True)
class Zone:
    """A zone of the base (m), and its action while points are inside."""

    name: str
    points: tuple[tuple[float, float], ...]
    """The corners of a polygon; empty for a circle."""
    action_type: str
    """The action: stop, slowdown, limit or approach."""
    radius: float = 0.0
    min_points: int = 4
    slowdown_ratio: float = 0.5
    linear_limit: float = 0.5
    angular_limit: float = 0.5
    time_before_collision: float = 2.0
    simulation_time_step: float = 0.1

    def parameters(self) -> Mapping[str, Parameter]:
        """The parameters of the node for this zone."""
        corners = ", ".join(f"[{x}, {y}]" for x, y in self.points)
        shape: dict[str, Parameter] = {"type": "circle", "radius": self.radius}
        if self.points:
            shape = {"type": "polygon", "points": f"[{corners}]"}
        numbers = {
            "slowdown": {"slowdown_ratio": self.slowdown_ratio},
            "limit": {"linear_limit": self.linear_limit, "angular_limit": self.angular_limit},
            "approach": {
                "time_before_collision": self.time_before_collision,
                "simulation_time_step": self.simulation_time_step,
            },
        }
        own: dict[str, Parameter] = {"action_type": self.action_type, "min_points": self.min_points}
        found = {**shape, **own, **numbers.get(self.action_type, {})}
        return {f"{self.name}.{key}": value for key, value in found.items()}


@dataclass(frozen=True)
class Settings:
    """The zones, and the maximum age of a scan (s)."""

    name: str
    zones: tuple[Zone, ...]
    source_timeout: float = 2.0

    def parameters(self) -> Mapping[str, Parameter]:
        """The parameters of the node. The scan is in the frame of the base."""
        found: dict[str, Parameter] = {
            "base_frame_id": "base_link",
            "cmd_vel_in_topic": "cmd_vel_smoothed",
            "cmd_vel_out_topic": "cmd_vel",
            "base_shift_correction": False,
            "source_timeout": self.source_timeout,
            "observation_sources": ["scan"],
            "scan.type": "scan",
            "scan.topic": "scan",
            "polygons": [zone.name for zone in self.zones],
        }
        for zone in self.zones:
            found |= zone.parameters()
        return found


def box(low_x: float, high_x: float, half_width: float) -> tuple[tuple[float, float], ...]:
    """The corners of a rectangle."""
    return (
        (high_x, half_width),
        (high_x, -half_width),
        (low_x, -half_width),
        (low_x, half_width),
    )


FOOTPRINT = box(-HALF_LENGTH, HALF_LENGTH, HALF_WIDTH)
LATENCY_S = 0.2
"""The latency (s): the age of a scan, the time until the next scan, and the time until the next
command.
"""

STOP_M = SPEED * LATENCY_S + SPEED**2 / (2 * BRAKING)
"""The stopping distance: the distance of the latency plus the braking distance."""

SIDE_M = 0.05

SHIPPED = Settings(
    "Nav2: approach",
    (
        Zone(
            "FootprintApproach",
            FOOTPRINT,
            "approach",
            min_points=6,
            time_before_collision=1.2,
            simulation_time_step=0.1,
        ),
    ),
    source_timeout=1.0,
)
"""The settings of `nav2_bringup`, with the outline of this base."""

ZONES = Settings(
    "Nav2: zones",
    (
        Zone("Stop", box(-HALF_LENGTH, HALF_LENGTH + STOP_M, HALF_WIDTH + SIDE_M), "stop"),
        Zone(
            "Slow",
            box(-HALF_LENGTH, HALF_LENGTH + 2 * STOP_M, HALF_WIDTH + 4 * SIDE_M),
            "slowdown",
            slowdown_ratio=0.5,
        ),
    ),
    source_timeout=0.3,
)
"""A zone with the length of the stopping distance, and a zone of twice this length in which the
base slows down. A scan is too old if three scans are missing."""

ALL = (SHIPPED, ZONES)
