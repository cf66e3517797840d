"""One environment behind a guard."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, SupportsFloat

import numpy as np
from gymnasium import Env, Wrapper
from gymnasium.utils import RecordConstructorArgs
from numpy.typing import NDArray

from rossmarie.guard import Decision
from rossmarie.gym.interface import Declarations, Interface, Latched, Rules
from rossmarie.gym.observations import Array, Spots


class GuardedEnv(Wrapper[Any, Any, Any, Any], RecordConstructorArgs):
    """An environment in which only what the rules allow is executed.

    The guard has seen the observation that the policy saw when it bounds the action; then it sees
    the observation that follows, one period later. Time is counted in steps, from 0 in each
    episode. `info` has:

    - `guard`: the actions `proposed` and `executed`, `intervened` (whether they differ, or would
      with rules that are enforced), `active` (which rules are active at the new observation, in
      the order of `rules`), `feedback` (that of each rule for this step) and `margin` (at the new
      observation, in the order of `rules_with_margin`);
    - `cost`: 1.0 if a rule was active in the step, added to that of the environment if it has one;
    - `action_mask`, for choices: 1 for each that would pass as it is in the next step;
    - `no_choice_passes`, for choices: true if the mask is 0 throughout. The choice that is nearest
      to what the rules allow is executed then, though they do not allow it.
    """

    def __init__(
        self,
        env: Env[Any, Any],
        rules: Rules,
        *,
        period_ns: int,
        observe: Spots,
        act: Mapping[str, Any],
        latched: Latched = "hold",
        targets: Mapping[str, Any] | None = None,
        with_feedback: bool = False,
        substeps: int = 1,
        enforce: bool = True,
        one_by_one: bool = False,
    ) -> None:
        """`observe` and `act` are the declarations of `Monitor.guard`; in a dictionary of
        observations a place stands behind its key, and for choices `act` has a list with the number
        of each. `latched` says whether a latched rule holds the robot or truncates the episode.
        `targets` are names of `act` that are places to go to, with the numbers of observations that
        say where the robot is. `with_feedback` takes the feedback of all rules from the reward.
        `substeps` is how often the environment computes its physics in a step; then it may tell the
        guard what there is to see after each, by `observe_substep`. Without `enforce` actions are
        executed as proposed, and the guard only tells what it would do. With `one_by_one` the
        topics of an observation arrive one after the other, as at a node of ROS: then verdicts are
        those of a node, also of rules that look at several topics. The rules are a file, or a
        monitor of it.

        Raises `RulesError` for rules with errors, and `MappingError` for declarations that do not
        fit the rules or the spaces.
        """
        RecordConstructorArgs.__init__(
            self, _disable_deepcopy=True, rules=rules, period_ns=period_ns, observe=observe,
            act=act, latched=latched, targets=targets, with_feedback=with_feedback,
            substeps=substeps, enforce=enforce, one_by_one=one_by_one,
        )  # fmt: skip
        super().__init__(env)
        declared = Declarations(rules, period_ns, observe, act, latched, targets or {}, enforce)
        self._interface = Interface(declared, env.observation_space, env.action_space)
        self.guard = self._interface.guard
        self.decision: Decision | None = None
        """The decision of the last step: its reasons, and what rules want done beside it."""
        self._with_feedback = with_feedback
        self._one_by_one = one_by_one
        self._substeps = self._interface.require_substeps(substeps)
        self._begin()

    @property
    def rules(self) -> tuple[str, ...]:
        """The names of the rules."""
        return self.guard.rules

    @property
    def rules_with_margin(self) -> tuple[str, ...]:
        """The names of the rules that declare a margin."""
        return self.guard.rules_with_margin

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begin another episode, of which the guard has seen the first observation only."""
        observation, info = self.env.reset(seed=seed, options=options)
        self.guard.restart()
        self.decision = None
        self._begin()
        flat = self._interface.observations.row(observation)
        self._interface.targets.reset(flat)
        self._active = self.guard.observe(0, flat)
        return observation, self._with_mask(info)

    def step(self, action: Any) -> tuple[Any, SupportsFloat, bool, bool, dict[str, Any]]:
        """Take a step with what may be done of an action."""
        passed = self._interface.passed(action, self._decide, self.guard.allows)
        self._feedback = np.zeros(len(self.rules))
        self._was_active = False
        self._taken = 0
        observation, reward, terminated, truncated, info = self.env.step(passed.executed)
        self._taken = self._substeps
        self._begun_ns += self._interface.period_ns
        self._observe(self._begun_ns, observation)
        active, feedback = self._active, self._feedback
        if self._with_feedback:
            reward = float(reward) - float(feedback.sum())
        reported = {
            "proposed": passed.proposed,
            "executed": passed.executed,
            "intervened": bool(passed.intervened),
            "active": active,
            "feedback": feedback,
            "margin": self.guard.margin,
        }
        cost = float(info.get("cost", 0.0)) + float(self._was_active)
        is_over = bool(self._interface.is_over(active))
        whole = self._with_mask({**info, "guard": reported, "cost": cost})
        return observation, reward, terminated, truncated or is_over, whole

    def action_masks(self) -> NDArray[np.bool_]:
        """Say which choices would pass as they are in the next step, as MaskablePPO asks for them.
        Raises `TypeError` where actions are no choices.
        """
        mask = self._interface.actions.mask(self.guard.allows)
        if mask is None:
            raise TypeError("actions are vectors: they are bounded, and have no masks")
        return mask.astype(np.bool_)

    def observe_substep(self, observation: Any) -> None:
        """Let the guard see an observation in the midst of a step, after one more substep of it:
        for environments to call. What rules then want holds from the next step on. Raises
        `ValueError` outside of a step, and if it has no more substeps.
        """
        if self._taken == self._substeps:
            raise ValueError(
                f"this is no step, or it has more than `substeps` ({self._substeps}) substeps"
            )
        self._taken += 1
        elapsed_ns = self._taken * self._interface.period_ns // self._substeps
        self._observe(self._begun_ns + elapsed_ns, observation)

    def _begin(self) -> None:
        """An episode begins, of which nothing has been seen."""
        self._begun_ns = self._at_ns = 0
        self._taken = self._substeps
        self._active = np.zeros(len(self.rules), np.bool_)
        self._was_active = False
        self._feedback = np.zeros(len(self.rules))

    def _observe(self, at_ns: int, observation: Any) -> None:
        """Let the guard see what there is at an instant of a step."""
        row = self._interface.observations.row(observation)
        active = self.guard.observe(at_ns, row, one_by_one=self._one_by_one)
        elapsed_ns = at_ns - self._at_ns
        self._feedback += self._interface.feedback.between(self._active, active, elapsed_ns)
        self._was_active |= bool(active.any())
        self._active, self._at_ns = active, at_ns

    def _decide(self, flat: Array) -> Array:
        self.decision = self.guard.decide(flat)
        return self.decision.action

    def _with_mask(self, info: dict[str, Any]) -> dict[str, Any]:
        mask = self._interface.actions.mask(self.guard.allows)
        if mask is None:
            return info
        return {**info, "action_mask": mask, "no_choice_passes": not mask.any()}
