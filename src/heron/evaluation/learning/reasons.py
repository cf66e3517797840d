"""Known reasons for failing expectations, by formulation, algorithm and expectation. The page shows
a reason only if its expectation fails.
"""

from __future__ import annotations

from collections.abc import Mapping

_RARE = (
    "PPO hardly ever gets to the fragile part, also without the guard: most trainings have no such "
    "episode in any arm, and the median of the differences is zero."
)
_SLOW = (
    "The rules bound the speed near the hole. With the guard an episode lasts nearly all of its "
    "time, and a training has fewer than half as many episodes. Insertions still become more when "
    "the steps are used up."
)
_CALM = (
    "Numbers that insert keep to the rules by themselves: in the last quarter of a training hardly "
    "any episode has a violation, also without the guard. Little is left to be less."
)

REASONS: Mapping[tuple[str, str, str], str] = {
    ("steps", "ppo", "unguarded touched > guard touched"): _RARE,
    ("steps", "ppo", "unguarded touched > guard_feedback touched"): _RARE,
    ("steps", "ppo", "unguarded touched > executed touched"): _RARE,
    ("steps", "ppo", "executed as soon"): (
        "Where the rules bound an action, all proposals beyond the bound are executed as one and "
        "the same action. Nothing that is learned from it draws the proposals back: more of them "
        "are outside of the rules than where the learner knows its proposals. Nobody has tried "
        "this reason by itself."
    ),
    ("steps", "sac", "unguarded steps_to_good > guard steps_to_good"): (
        "The steps of a training are too few for SAC: hardly any training gets there in any arm."
    ),
    ("moves", "ppo", "unguarded steps_to_good > guard steps_to_good"): _SLOW,
    ("moves", "ppo", "as good"): _SLOW,
    ("moves", "ppo", "less later"): (
        "At first the peg stays far from the hole, where few rules hold. The longer a training "
        "takes, the longer is the peg near the hole, where they hold in most steps."
    ),
    ("tree", "cma-es", "unguarded violating_late > ended violating_late"): (
        f"{_CALM} Some trainings that end at a violation never learn to insert, and have one in "
        "most of their episodes."
    ),
    ("tree", "cma-es", "unguarded violating_late > penalty violating_late"): _CALM,
    ("tree", "cma-es", "unguarded steps_to_good > guard steps_to_good"): (
        "CMA-ES compares whole episodes. The rules make an episode of the same numbers a little "
        "slower and do not end it, so that better numbers stay better."
    ),
    ("tree", "cma-es", "guard violating_unguarded > guard_feedback violating_unguarded"): (
        "Nothing is left to be less: what was learned behind the guard has no violation without it."
    ),
}
