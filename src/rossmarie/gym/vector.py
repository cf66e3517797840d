"""Many environments behind guards. One call decides for all of them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from gymnasium import logger
from gymnasium.vector import AutoresetMode, VectorEnv, VectorWrapper
from numpy.typing import NDArray

from rossmarie.guard import MappingError
from rossmarie.gym.interface import Declarations, Interface, Latched, Rules
from rossmarie.gym.observations import Array, Spots

Mask = NDArray[np.bool_]


class GuardedVectorEnv(VectorWrapper[Any, Any, Any, Any, Any]):
    """Environments that execute only permitted actions, each like a `GuardedEnv`.

    `infos` has the same entries, with a row for each environment, and masks in Gymnasium's form.
    `metadata["autoreset_mode"]` determines how an episode ends and the next episode begins. In
    NEXT_STEP, an environment ignores its action in the step in which it begins an episode; then
    `_executed` is False.
    """

    def __init__(
        self,
        env: VectorEnv[Any, Any, Any],
        rules: Rules,
        *,
        period_ns: int,
        observe: Spots,
        act: Mapping[str, Any],
        latched: Latched = "hold",
        targets: Mapping[str, Any] | None = None,
        with_feedback: bool = False,
        enforce: bool = True,
    ) -> None:
        """The arguments are those of `GuardedEnv`. Environments that begin episodes by themselves
        do not know that a latched rule has truncated an episode, so for them `latched` is "hold";
        alternatively, make each of them a `GuardedEnv`. Raises the errors of `GuardedEnv`.
        """
        super().__init__(env)
        self._mode = _mode_of(env)
        if latched == "truncate" and self._mode is not AutoresetMode.DISABLED:
            raise MappingError(
                'latched="truncate" needs environments that are reset by a mask '
                '(autoreset_mode=DISABLED); or let each one be a GuardedEnv with latched="truncate"'
            )
        declared = Declarations(rules, period_ns, observe, act, latched, targets or {}, enforce)
        self._interface = Interface(declared, env.single_observation_space, env.single_action_space)
        self._guards = self._interface.guard.batch(env.num_envs)
        self._at_ns = np.zeros(env.num_envs, np.int64)
        self._ended = np.zeros(env.num_envs, np.bool_)
        self._with_feedback = with_feedback
        self._active = np.zeros((env.num_envs, len(self.rules)), np.bool_)

    @property
    def rules(self) -> tuple[str, ...]:
        """The names of the rules."""
        return self._guards.rules

    @property
    def rules_with_margin(self) -> tuple[str, ...]:
        """The names of the rules that declare a margin."""
        return self._guards.rules_with_margin

    def reset(
        self, *, seed: Any = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begin another episode in all environments, or in those that `options["reset_mask"]`
        marks.
        """
        marked = (options or {}).get("reset_mask")
        which = np.ones(self.num_envs, np.bool_) if marked is None else np.array(marked, np.bool_)
        observations, infos = self.env.reset(seed=seed, options=options)
        self._begin(self._seen(observations), which)
        return observations, self._with_mask(infos)

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """Perform a step in each environment with the permitted form of its action."""
        anew = self._ended & (self._mode is AutoresetMode.NEXT_STEP)
        passed = self._interface.passed(
            actions,
            lambda flat: self._guards.decide(flat, ~anew).actions,
            self._guards.allows,
            ~anew,
        )
        observations, rewards, terminated, truncated, infos = self.env.step(passed.executed)
        ended = terminated | truncated
        before = self._active
        active, margin = self._observe(self._seen(observations), infos, anew, ended)
        truncated = truncated | (self._interface.is_over(active) & ~anew)
        self._ended = terminated | truncated
        feedback = self._interface.feedback.between(before, active, self._interface.period_ns)
        feedback[anew] = 0.0
        if self._with_feedback:
            rewards = rewards - feedback.sum(axis=-1)
        reported = {
            "proposed": passed.proposed,
            "executed": passed.executed,
            "intervened": passed.intervened,
            "active": active,
            "feedback": feedback,
            "margin": margin,
        }
        everywhere = np.ones(self.num_envs, np.bool_)
        masks = {f"_{name}": everywhere for name in reported} | {"_executed": ~anew}
        cost = np.asarray(infos.get("cost", 0.0)) + (active.any(axis=-1) & ~anew)
        whole = {**infos, "guard": {**reported, **masks}, "_guard": everywhere}
        whole |= {"cost": cost, "_cost": everywhere}
        return observations, rewards, terminated, truncated, self._with_mask(whole)

    # --- observations ------------------------------------------------------------------------

    def _observe(
        self, seen: Array, infos: Mapping[str, Any], anew: Mask, ended: Mask
    ) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
        """Process the observations of a step. Returns a mask of the active rules, and the
        margins.
        """
        last = self._last(seen, infos, ended)
        self._at_ns[~anew] += self._interface.period_ns
        if anew.any():
            self._begin(seen, anew)
        active = self._guards.observe(self._at_ns, last, ~anew if anew.any() else None)
        margin = self._guards.margin
        self._active = active
        if self._mode is AutoresetMode.SAME_STEP and ended.any():
            self._begin(seen, ended)
        return active, margin

    def _last(self, seen: Array, infos: Mapping[str, Any], ended: Mask) -> Array:
        """The last observations of ended episodes. SAME_STEP returns them beside the first
        observations of the next episodes.
        """
        if self._mode is not AutoresetMode.SAME_STEP or not ended.any():
            return seen
        last = np.array(seen)
        for row in np.flatnonzero(ended).tolist():
            last[row] = self._interface.observations.row(infos["final_obs"][row])
        return last

    def _begin(self, seen: Array, which: Mask) -> None:
        """Begin episodes in the marked environments."""
        self._guards.restart(which)
        self._at_ns[which] = 0
        self._ended = self._ended & ~which
        self._interface.targets.reset(seen, which)
        self._active = self._guards.observe(self._at_ns, seen, which)

    def _seen(self, observations: Any) -> Array:
        return self._interface.observations.rows(observations, self.num_envs)

    def _with_mask(self, infos: dict[str, Any]) -> dict[str, Any]:
        mask = self._interface.actions.mask(self._guards.allows)
        if mask is None:
            return infos
        reported = {"action_mask": mask, "no_choice_passes": ~mask.any(axis=-1)}
        everywhere = np.ones(self.num_envs, np.bool_)
        return {**infos, **reported, **{f"_{name}": everywhere for name in reported}}


def _mode_of(env: VectorEnv[Any, Any, Any]) -> AutoresetMode:
    """The mode in which environments begin new episodes."""
    if "autoreset_mode" not in env.metadata:
        logger.warn(f"{env} does not say its autoreset_mode; its guard goes by NEXT_STEP")
        return AutoresetMode.NEXT_STEP
    return AutoresetMode(env.metadata["autoreset_mode"])
