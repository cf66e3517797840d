"""The names of formulations and algorithms on pages and in tables."""

from __future__ import annotations

from collections.abc import Mapping

from heron.variants import Formulation

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
