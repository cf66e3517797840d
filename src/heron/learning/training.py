"""One training: a step learner in one arm of the study, with one seed."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import gymnasium
import numpy as np
from numpy.typing import NDArray

import heron.learning  # noqa: F401  # registers the environments
from heron.learning.arms import LearningArm, guarded
from heron.learning.insertion import FIELDS, LONGEST_S, Outcome
from heron.learning.step_learners import SkrlLearner, StepLearner
from heron.scene.insertion import InsertionParameters

Floats = NDArray[np.float64]
ENVIRONMENTS = {"steps": "heron/PegInHole-v1", "moves": "heron/PegInHoleMoves-v1"}
"""The environment of each formulation."""
COUNT = 32
"""Environments that learn at once."""
_SIZES = {"place": 0.3, "velocity": 0.3, "force": 10.0, "person": 2.0, "left": LONGEST_S}
_SIZE = np.array([_SIZES[field.partition(".")[0]] for field in FIELDS])
_MIDDLE = np.append(np.array(InsertionParameters().hole), np.zeros(len(FIELDS) - 3))


@dataclass(frozen=True)
class Run:
    """A training: its formulation, its algorithm, its arm, and its seed."""

    formulation: str
    algorithm: str
    arm: LearningArm
    seed: int


class Episode(NamedTuple):
    """An episode of a training: `steps` of all environments before its end, and the time since the
    training began (s); `proposed_outside` are its steps whose proposed command the rules would not
    let pass as it is, and `executed_outside` those in which such a command was executed.
    """

    steps: int
    seconds: float
    length: int
    reward: float
    proposed_outside: int
    executed_outside: int
    outcome: Outcome


@dataclass
class Tally:
    """The counts of an episode that goes on, as `Episode` has them."""

    length: int = 0
    reward: float = 0.0
    proposed_outside: int = 0
    executed_outside: int = 0

    def count(self, reward: float, told: Any) -> None:
        """Take a step into account."""
        self.length += 1
        self.reward += reward
        self.proposed_outside += told["intervened"]
        is_executed = bool(np.all(told["executed"] == told["proposed"]))
        self.executed_outside += told["intervened"] and is_executed


class Trainer:
    """The environments of a training, and its learner."""

    def __init__(self, run: Run) -> None:
        self.run = run
        self._envs = [environment(run.formulation, run.arm) for _ in range(COUNT)]
        one = self._envs[0]
        self.learner: StepLearner = SkrlLearner(
            run.algorithm, one.observation_space, one.action_space, COUNT, run.seed
        )
        self.steps = 0

    def train(self, steps: int) -> Iterator[Episode]:
        """Learn until all environments have taken so many steps, and tell of each episode."""
        began = time.monotonic()
        seen = np.array([env.reset(seed=self._seed(i))[0] for i, env in enumerate(self._envs)])
        going = [Tally() for _ in self._envs]
        while self.steps < steps:
            proposed = self.learner.act(scaled(seen))
            taken = [env.step(each) for env, each in zip(self._envs, proposed, strict=True)]
            following, rewards, terminated, truncated, infos = zip(*taken, strict=True)
            ended = np.array(terminated) | np.array(truncated)
            self.learner.learn(
                scaled(seen),
                self._own(proposed, infos),
                np.array(rewards),
                scaled(np.array(following)),
                ended,
            )
            self.steps += COUNT
            seen = np.array(following)
            for i, info in enumerate(infos):
                going[i].count(float(rewards[i]), info["guard"])
                if ended[i]:
                    seconds = time.monotonic() - began
                    found = going[i]
                    yield Episode(
                        self.steps,
                        seconds,
                        found.length,
                        found.reward,
                        found.proposed_outside,
                        found.executed_outside,
                        info["outcome"],
                    )
                    going[i] = Tally()
                    seen[i] = self._envs[i].reset()[0]

    def _seed(self, number: int) -> int:
        return self.run.seed * COUNT + number

    def _own(self, proposed: Any, infos: Sequence[Any]) -> Any:
        """The actions that the learner takes for its own."""
        if self.run.arm is not LearningArm.EXECUTED:
            return proposed
        return np.array([info["guard"]["executed"] for info in infos])


def environment(formulation: str, arm: LearningArm) -> gymnasium.Env[Any, Any]:
    """A new environment of a formulation, in an arm of the study."""
    return guarded(gymnasium.make(ENVIRONMENTS[formulation], disable_env_checker=True), arm)


def scaled(observations: Floats) -> Floats:
    """Observations as learners get them: places from the hole on, and everything about 1."""
    found: Floats = (observations - _MIDDLE) / _SIZE
    return found
