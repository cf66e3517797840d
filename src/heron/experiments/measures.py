"""The measures of the navigation experiment, from the ground truth and the actions of the guard."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from heron.experiments.trace import EpisodeTrace
from heron.guard import Occurrence
from heron.robot.physics import Floats
from heron.scene import BaseParameters, Course
from heron.scene.base import AXLES
from heron.scene.scene import STEP_NS
from rossmarie.ir import TaskCommandKind

_GRAVITY = 9.81
_BANDWIDTH = 50.0  # Hz; higher frequencies are ringing of the contact model
_ON_SLOPE = math.radians(10)
_ON_STEEP_SLOPE = math.radians(20)
_SHAKEN = 0.5  # s that an axle may swing on after a bump
_TOUCHED = 0.1  # s before the bump that count as on the bump
_FORESEEN = 3.0  # s after a hazard in which caution is no needless one
Flags = NDArray[np.bool_]


@dataclass(frozen=True)
class NavigationMeasures:
    """Times in s, accelerations in m/s^2. `peaks` are the largest accelerations at the axles on the
    bump, by the names of the axles, and the largest acceleration of any axle at other places, as
    `elsewhere`. All are below 50 Hz and without gravity. `distance` is the distance travelled by
    the base (m). `time_over_torque` is the time during which a wheel had at least the usual torque
    limit, at any current limit. `reactions` are the times from the beginning of a hazard to the
    first action of a rule against this hazard, for hazards with a reaction.
    """

    is_completed: bool
    duration: float
    interventions: int
    replanned: int
    distance: float
    peaks: Mapping[str, float]
    time_over_torque: float
    reactions: Mapping[str, float]
    time_restricted: float
    time_restricted_without_need: float


def peaks(trace: EpisodeTrace, is_on_bump: Flags) -> dict[str, float]:
    """The greatest acceleration of each axle on the bump, if there is one, and elsewhere; on
    whichever side.
    """
    sizes = {axle: _sizes(trace.accelerations[axle]) for axle in AXLES}
    there = prolonged(is_on_bump, _SHAKEN) | prolonged(is_on_bump[::-1], _TOUCHED)[::-1]
    found = {axle: float(sizes[axle][there].max()) for axle in AXLES if there.any()}
    found["elsewhere"] = max(float(each[~there].max(initial=0.0)) for each in sizes.values())
    return found


def _sizes(accelerations: Floats) -> Floats:
    """The size (m/s^2) of the greater of both sides at each row; given are (rows, sides, 3)."""
    kernel = _low_pass()
    half = len(kernel) // 2  # where the kernel hangs over the ends there is nothing to see
    found: Floats = np.zeros(len(accelerations))
    if len(accelerations) > 2 * half:
        smooth = np.apply_along_axis(
            lambda column: np.convolve(column, kernel, "valid"), 0, accelerations
        )
        found[half:-half] = np.abs(np.linalg.norm(smooth, axis=2) - _GRAVITY).max(axis=1)
    return found


def _low_pass() -> Floats:
    """A windowed sinc: no delay, and nothing that rings on."""
    rate = 1e9 / STEP_NS
    half = round(rate / _BANDWIDTH)
    instants = np.arange(-half, half + 1)
    kernel: Floats = np.sinc(2 * _BANDWIDTH / rate * instants) * np.hamming(len(instants))
    kernel /= kernel.sum()
    return kernel


# --- hazards ---------------------------------------------------------------------------------


def hazards(trace: EpisodeTrace, course: Course, base: BaseParameters) -> dict[str, Flags]:
    """The times at which each hazard is present: an axle on the bump, a slope under the base."""
    tilt = np.abs(trace.columns["pitch"])
    return {
        "bump": _on_bump(trace, course, base),
        "gentle": (tilt > _ON_SLOPE) & (tilt <= _ON_STEEP_SLOPE),
        "steep": tilt > _ON_STEEP_SLOPE,
    }


def _on_bump(trace: EpisodeTrace, course: Course, base: BaseParameters) -> Flags:
    """Return True from the front axle's first contact with the bump until the rear axle has left
    it.
    """
    if course.bump is None:
        return np.zeros(len(trace.times), dtype=np.bool_)
    low, high = course.bump
    reach = _reach(course, base)
    x = trace.columns["x"]
    here: Flags = (x + base.front_x >= low - reach) & (x + base.rear_x <= high + reach)
    return here & (np.abs(trace.columns["y"]) < 1.2)


def _reach(course: Course, base: BaseParameters) -> float:
    """The distance before the bump at which a wheel touches it."""
    found, wheel = course.parameters, base.wheel_radius
    low, high = course.bump or (0.0, 0.0)
    apart = found.bump_radius + wheel
    between = apart - found.bump_height
    return math.sqrt(apart**2 - between**2) - (high - low) / 2


def reactions(
    trace: EpisodeTrace, present: Mapping[str, Flags], occurrences: Sequence[Occurrence]
) -> dict[str, float]:
    """The time from the start of each hazard to the first action of a rule with the hazard's name
    in its own name.
    """
    found = {}
    for hazard, flags in present.items():
        starts = [
            each.at_ns * 1e-9
            for each in occurrences
            if each.kind is TaskCommandKind.START and hazard in each.rule
        ]
        onsets = trace.times[flags]
        if len(onsets) and (after := [at for at in starts if at >= onsets[0]]):
            found[hazard] = after[0] - float(onsets[0])
    return found


def onsets(trace: EpisodeTrace, present: Mapping[str, Flags]) -> dict[str, float]:
    """The instant (s) at which each hazard began, of those that there were."""
    return {
        hazard: float(trace.times[flags][0]) for hazard, flags in present.items() if flags.any()
    }


def time_of(flags: Flags) -> float:
    """The time for which something was so."""
    return float(np.count_nonzero(flags)) * STEP_NS * 1e-9


def without_need(trace: EpisodeTrace, present: Mapping[str, Flags]) -> Flags:
    """The times at which commands were restricted although no hazard was present or had just
    ended.
    """
    is_restricted = trace.columns["is_restricted"] > 0
    needed = np.any(list(present.values()), axis=0)
    return is_restricted & ~prolonged(needed, _FORESEEN)


def prolonged(flags: Flags, seconds: float) -> Flags:
    """Each stretch of true is so many seconds longer."""
    steps = round(seconds * 1e9 / STEP_NS)
    rows = np.arange(len(flags))
    last = np.maximum.accumulate(np.where(flags, rows, -steps - 1))
    found: Flags = rows - last <= steps
    return found
