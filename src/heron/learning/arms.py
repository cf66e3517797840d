"""The arms of the study: the combinations of rules and a learner."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

import gymnasium

from heron.learning.environment import MOVES, PegInHole
from heron.learning.insertion import FIELDS, PERIOD_NS, READINGS, InsertionOutcome
from heron.rules import FOLDER
from heron.variants import LearningArm
from rossmarie import Monitor, load
from rossmarie.gym import GuardedEnv

RULES = FOLDER / "insertion.ross"
_SEEN = {
    **{f"place.{axis}": FIELDS.index(f"place.{axis}") for axis in "xyz"},
    **{f"force.{axis}": FIELDS.index(f"force.{axis}") for axis in "xyz"},
    "person": FIELDS.index("person"),
}
_UNUSED = (
    *(f"angular.{axis}" for axis in "xyz"),
    *(f"/arm/push.force.{axis}" for axis in "xy"),
    *(f"/arm/push.torque.{axis}" for axis in "xyz"),
)
_USED = ("linear.x", "linear.y", "linear.z", "/arm/push.force.z")


ARM_NAMES: Mapping[LearningArm, str] = {
    LearningArm.UNGUARDED: "unguarded",
    LearningArm.ENDED: "ended",
    LearningArm.PENALTY: "penalty",
    LearningArm.GUARD: "guard",
    LearningArm.GUARD_FEEDBACK: "guard, feedback",
    LearningArm.EXECUTED: "guard, executed",
}
"""The arms, as pages and films name them."""
_ENFORCED = (LearningArm.GUARD, LearningArm.GUARD_FEEDBACK, LearningArm.EXECUTED)
_WITH_FEEDBACK = (LearningArm.PENALTY, LearningArm.GUARD_FEEDBACK)


def is_guarded(arm: LearningArm) -> bool:
    """Return True if the rules bound the executed action."""
    return arm in _ENFORCED


def guarded(env: gymnasium.Env[Any, Any], arm: LearningArm) -> gymnasium.Env[Any, Any]:
    """A new environment of this package behind the rules, in an arm of the study."""
    task = env.unwrapped
    assert isinstance(task, PegInHole)
    found = GuardedEnv(
        env,
        _monitor(),
        period_ns=PERIOD_NS,
        observe=_SEEN,
        act=_declared(env.action_space),
        with_feedback=arm in _WITH_FEEDBACK,
        substeps=READINGS,
        enforce=is_guarded(arm),
        one_by_one=True,
    )
    task.on_reading.append(found.observe_substep)
    return EndedAtViolation(found, task) if arm is LearningArm.ENDED else found


class EndedAtViolation(gymnasium.Wrapper[Any, Any, Any, Any]):
    """An episode ends with the first violation."""

    def __init__(self, env: gymnasium.Env[Any, Any], task: PegInHole) -> None:
        super().__init__(env)
        self._task = task

    def step(self, action: Any) -> Any:
        """Take a step."""
        observation, reward, terminated, truncated, info = super().step(action)
        outcome: InsertionOutcome = self._task.insertion.outcome
        if outcome.violations and not terminated:
            terminated = True
            info = {**info, "outcome": outcome}
        return observation, reward, terminated, truncated, info


def _declared(actions: gymnasium.Space[Any]) -> dict[str, Any]:
    """The meaning of the numbers of an action, or of each choice."""
    if isinstance(actions, gymnasium.spaces.Discrete):
        chosen = {name: [move[place] for move in MOVES] for place, name in enumerate(_USED)}
        return chosen | {name: [0.0] * len(MOVES) for name in _UNUSED}
    return dict.fromkeys(_UNUSED) | {name: place for place, name in enumerate(_USED)}


@cache
def _monitor() -> Monitor:
    return load(RULES)
