"""The names of formulations and arms on pages and in tables."""

from __future__ import annotations

from collections.abc import Mapping

from heron.variants import Formulation, LearningArm

TITLES: Mapping[Formulation, str] = {
    Formulation.STEPS: "a policy of velocities",
    Formulation.MOVES: "a policy of moves",
    Formulation.TREE: "the numbers of a behavior tree",
}
ALGORITHM_NAMES: Mapping[str, str] = {
    "ppo": "PPO",
    "sac": "SAC",
    "cma-es": "CMA-ES",
}
ARM_NAMES: Mapping[LearningArm, str] = {
    LearningArm.UNGUARDED: "unguarded",
    LearningArm.ENDED: "ended",
    LearningArm.PENALTY: "penalty",
    LearningArm.GUARD: "guard",
    LearningArm.GUARD_FEEDBACK: "guard, feedback",
    LearningArm.EXECUTED: "guard, executed",
}
