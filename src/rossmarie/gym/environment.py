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
    """An environment that executes only permitted actions.

    When the guard bounds an action, it has processed the same observation as the policy. Then it
    processes the next observation, one period later. Time is counted in steps, from 0 in each
    episode. `info` has these entries:

    - `guard`: a dictionary with these entries:
        - `proposed` and `executed`: the actions;
        - `intervened`: True if the actions differ, or would differ if the rules were enforced;
        - `active`: a mask of the active rules at the new observation, in the order of `rules`;
        - `feedback`: the feedback of each rule for this step;
        - `margin`: the margins at the new observation, in the order of `rules_with_margin`.
    - `cost`: 1.0 if a rule was active in the step, plus the environment's own cost, if it has one.
    - `action_mask`, for choices: 1 for each choice that would pass unchanged in the next step.
    - `no_choice_passes`, for choices: True if the whole mask is 0. Then the choice nearest to the
      permitted numbers is executed, although the rules do not permit it.
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
        """`observe` and `act` are the declarations of `Monitor.guard`. In a dictionary of
        observations, the key precedes the place; for choices, `act` has a list with the number of
        each choice. With `latched`, a latched rule holds the robot or truncates the episode.
        `targets` maps names of `act` that are target positions to the numbers of the observation
        with the present position. With `with_feedback`, the feedback of all rules is subtracted
        from the reward. `substeps` is the number of physics steps of the environment in a step;
        after each, the environment may report an observation with `observe_substep`. Without
        `enforce`, actions are executed as proposed, and the guard only reports its decisions. With
        `one_by_one`, the topics of an observation arrive one after another, as at a ROS node; then
        verdicts equal those of a node, also for rules that use several topics. `rules` is a file,
        or a monitor of a file.

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
        """The decision of the last step: its reasons, and the requests of rules beside the
        action.
        """
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
        """Begin another episode. The guard has processed only the first observation."""
        observation, info = self.env.reset(seed=seed, options=options)
        self.guard.restart()
        self.decision = None
        self._begin()
        flat = self._interface.observations.row(observation)
        self._interface.targets.reset(flat)
        self._active = self.guard.observe(0, flat)
        return observation, self._with_mask(info)

    def step(self, action: Any) -> tuple[Any, SupportsFloat, bool, bool, dict[str, Any]]:
        """Perform a step with the permitted form of an action."""
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
        """A mask of the choices that would pass unchanged in the next step, in the form that
        MaskablePPO needs. Raises `TypeError` if actions are not choices.
        """
        mask = self._interface.actions.mask(self.guard.allows)
        if mask is None:
            raise TypeError("actions are vectors: the guard bounds them, so there are no masks")
        return mask.astype(np.bool_)

    def observe_substep(self, observation: Any) -> None:
        """Let the guard process an observation within a step, after one more substep. Environments
        call this method. The reactions of rules take effect in the next step. Raises `ValueError`
        outside a step, and after the last substep.
        """
        if self._taken == self._substeps:
            raise ValueError(
                f"there is no step now, or it has more than {self._substeps} substeps (`substeps`)"
            )
        self._taken += 1
        elapsed_ns = self._taken * self._interface.period_ns // self._substeps
        self._observe(self._begun_ns + elapsed_ns, observation)

    def _begin(self) -> None:
        """Begin an episode without observations."""
        self._begun_ns = self._at_ns = 0
        self._taken = self._substeps
        self._active = np.zeros(len(self.rules), np.bool_)
        self._was_active = False
        self._feedback = np.zeros(len(self.rules))

    def _observe(self, at_ns: int, observation: Any) -> None:
        """Let the guard process an observation at an instant of a step."""
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
