"""Known reasons for failing expectations, by experiment, variant and expectation. The page shows a
reason only if its expectation fails.
"""

from __future__ import annotations

from collections.abc import Mapping

_FRONT = "The front axle meets the bump first, and its jolt is what the rules hear of it by."
_SLIPS = (
    "The toe of the steep ramp looks like a gentle slope, and the rules give more torque. So the "
    "base climbs on, its wheels slip, and its drive axle jerks for a second before it backs off. "
    "Without that torque the base stalls softly at the toe."
)
_SETTLES = (
    "The arm stands still with both. When ROSSMARie makes it gravity-free, so that it gives way to "
    "a push, it settles by a little."
)

REASONS: Mapping[tuple[str, str, str], str] = {
    ("nav", "gentle", "harm deros peak_front"): _FRONT,
    ("nav", "gentle", "harm rossmarie peak_front"): _FRONT,
    ("nav", "gentle", "safe collision_monitor peak_front"): (
        f"{_FRONT} The collision monitor hears nothing, and is as slow everywhere as it has to be "
        "on a bump."
    ),
    ("nav", "gentle", "fastest"): (
        "The slope needs more than the usual limit of torque. We chose that limit so that there is "
        "a hazard: see the study of it below."
    ),
    ("nav", "steep", "fastest"): (
        "No torque gets the base up this ramp, and without a monitor it does not turn back."
    ),
    ("nav", "steep", "harm rossmarie peak_elsewhere"): _SLIPS,
    ("nav", "steep", "safe collision_monitor peak_elsewhere"): _SLIPS,
    ("nav", "steep", "safe deros peak_elsewhere"): _SLIPS,
    ("place", "high", "harm deros time_above_30_n"): (
        "DeROS stops the arm as it stands, and it goes on pressing on the table until the operator "
        "has come."
    ),
    ("place", "high", "fastest"): (
        "The arm lets go of the block, and calls it placed, but it does not lie where it was to."
    ),
    ("human", "inside", "safe collision_monitor fastest_near"): _SETTLES,
    ("human", "inside", "safe collision_monitor risk"): _SETTLES,
    ("human", "inside", "safe deros fastest_near"): _SETTLES,
    ("human", "inside", "safe deros risk"): _SETTLES,
}
