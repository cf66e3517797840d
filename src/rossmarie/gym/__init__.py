"""Gymnasium environments behind a guard: the rules of operation also apply while a robot learns.

Needs the extra `rossmarie[gym]`.
"""

from rossmarie.extras import EXTRAS

try:
    import gymnasium as _  # noqa: F401
except ModuleNotFoundError as error:
    raise ImportError(f"rossmarie.gym needs Gymnasium: {EXTRAS.advice('gym')}") from error

from rossmarie.gym.environment import GuardedEnv
from rossmarie.gym.vector import GuardedVectorEnv

__all__ = ["GuardedEnv", "GuardedVectorEnv"]
