"""Known reasons for failing expectations, by formulation, algorithm and expectation. The page shows
a reason only if its expectation fails.
"""

from __future__ import annotations

from collections.abc import Mapping

_RARE = (
    "PPO rarely reaches the fragile part, also without the guard. Most trainings have no such "
    "episode in any arm, so the median of the differences is zero."
)
_SLOW = (
    "The rules limit the speed near the hole. With the guard, most episodes run until their time "
    "limit, so a training has fewer than half as many episodes. The share of insertions still "
    "rises when the steps are used up."
)
_CALM = (
    "Numbers that insert the peg also obey the rules. In the last quarter of a training, few "
    "episodes have a violation, also without the guard, so few violations can be avoided."
)

REASONS: Mapping[tuple[str, str, str], str] = {
    ("steps", "ppo", "unguarded touched > guard touched"): _RARE,
    ("steps", "ppo", "unguarded touched > guard_feedback touched"): _RARE,
    ("steps", "ppo", "unguarded touched > executed touched"): _RARE,
    ("steps", "ppo", "executed as soon"): (
        "If the rules limit an action, all proposals beyond the limit are executed as the same "
        "action. So the learner gets no incentive to move its proposals back inside the limit: "
        "more proposals are outside the rules than if the learner knows its proposals. No "
        "separate experiment has tested this explanation."
    ),
    ("steps", "sac", "unguarded steps_to_good > guard steps_to_good"): (
        "SAC needs more steps than a training has: few trainings reach this share in any arm."
    ),
    ("moves", "ppo", "unguarded steps_to_good > guard steps_to_good"): _SLOW,
    ("moves", "ppo", "as good"): _SLOW,
    ("moves", "ppo", "less later"): (
        "At first the peg stays far from the hole, where few rules are active. Later in a "
        "training, the peg is near the hole for longer, where rules are active in most steps."
    ),
    ("tree", "cma-es", "unguarded violating_late > ended violating_late"): (
        f"{_CALM} Some trainings whose episodes end at a violation never learn to insert, and most "
        "of their episodes have a violation."
    ),
    ("tree", "cma-es", "unguarded violating_late > penalty violating_late"): _CALM,
    ("tree", "cma-es", "unguarded steps_to_good > guard steps_to_good"): (
        "CMA-ES compares whole episodes. The rules make an episode a little slower and do not end "
        "the episode, so better numbers stay better."
    ),
    ("tree", "cma-es", "guard violating_unguarded > guard_feedback violating_unguarded"): (
        "The numbers that were learned with the guard cause no violation without the guard, so no "
        "violation can be avoided."
    ),
}
