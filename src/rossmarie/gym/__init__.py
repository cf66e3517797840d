"""Gymnasium environments behind a guard: the rules for operation hold while a robot learns.

Needs the extra `rossmarie[gym]`.
"""

try:
    import gymnasium as _  # noqa: F401
except ModuleNotFoundError as error:
    raise ImportError("rossmarie.gym needs Gymnasium: pip install 'rossmarie[gym]'") from error

from rossmarie.gym.environment import GuardedEnv
from rossmarie.gym.vector import GuardedVectorEnv

__all__ = ["GuardedEnv", "GuardedVectorEnv"]
