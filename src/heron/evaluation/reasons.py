"""Why an expectation fails, as far as that is known: by experiment, variant and claim. The page
shows a reason only where its expectation does fail.
"""

from __future__ import annotations

from collections.abc import Mapping

_FRONT = "The front axle meets the bump first, and its jolt is what the rules hear of it by."
_STALLS = "With the torque that it needs on the level, the base does not get up the slope."
_LED = (
    "DeROS has stopped the arm before anybody is near. With ROSSMARie it gives way to the person "
    "who leads it aside, and that is when it is fastest."
)

REASONS: Mapping[tuple[str, str, str], str] = {
    ("nav", "gentle", "harm deros peak_front"): _FRONT,
    ("nav", "gentle", "harm rossmarie peak_front"): _FRONT,
    ("nav", "gentle", "fastest"): _STALLS,
    ("nav", "steep", "harm deros peak_front"): _FRONT,
    ("nav", "steep", "harm rossmarie peak_front"): _FRONT,
    ("nav", "steep", "fastest"): _STALLS,
    ("nav", "steep", "safe peak_drive"): (
        "The toe of the steep ramp looks like a gentle slope: ROSSMARie gives more torque, and the "
        "base drives on over its edges until it is steep enough to back off. DeROS has stopped it "
        "at the toe."
    ),
    ("place", "high", "harm deros time_above_30_n"): (
        "DeROS stops the arm as it stands, and it goes on pressing on the table until the operator "
        "has come."
    ),
    ("place", "high", "fastest"): (
        "The arm lets go of the block, and calls it placed, but it does not lie where it was to."
    ),
    ("human", "inside", "safe fastest_near"): _LED,
    ("human", "inside", "safe risk"): _LED,
}
