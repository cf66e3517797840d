"""Known reasons for failing expectations, by experiment, variant and expectation. The page shows a
reason only if its expectation fails.
"""

from __future__ import annotations

from collections.abc import Mapping

_FRONT = (
    "The front axle reaches the bump first, and the rules detect the bump by the jolt of this axle."
)
_SLIPS = (
    "The foot of the steep ramp looks like a gentle slope, so the rules raise the torque limit. "
    "The base climbs further, the wheels slip, and the drive axle jerks for a second before the "
    "base backs off. With less torque, the base stalls softly at the foot."
)
_SETTLES = (
    "The arm stands still in both experiment arms. ROSSMARie switches the robot arm to gravity "
    "compensation, so that a push can move the arm. At the switch, the arm sinks a little."
)

REASONS: Mapping[tuple[str, str, str], str] = {
    ("nav", "gentle", "harm deros peak_front"): _FRONT,
    ("nav", "gentle", "harm rossmarie peak_front"): _FRONT,
    ("nav", "gentle", "safe collision_monitor peak_front"): (
        f"{_FRONT} The collision monitor cannot detect a bump, so the base always drives at the "
        "low speed that a bump needs."
    ),
    ("nav", "gentle", "fastest"): (
        "The slope needs more torque than the usual limit. We chose this limit to create a hazard: "
        "see the study of the limit below."
    ),
    ("nav", "steep", "fastest"): (
        "No torque is enough for this ramp, and without a monitor the base does not turn back."
    ),
    ("nav", "steep", "harm rossmarie peak_elsewhere"): _SLIPS,
    ("nav", "steep", "safe collision_monitor peak_elsewhere"): _SLIPS,
    ("nav", "steep", "safe deros peak_elsewhere"): _SLIPS,
    ("place", "high", "harm deros time_above_30_n"): (
        "DeROS stops the arm where it is, so the arm presses on the table until the operator "
        "arrives."
    ),
    ("place", "high", "fastest"): (
        "The arm releases the block and reports success, but the block is not at its target."
    ),
    ("human", "inside", "safe collision_monitor fastest_near"): _SETTLES,
    ("human", "inside", "safe collision_monitor risk"): _SETTLES,
    ("human", "inside", "safe deros fastest_near"): _SETTLES,
    ("human", "inside", "safe deros risk"): _SETTLES,
}
