"""The training of a step learner: many environments, and one learner."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from typing import Any

import gymnasium
import numpy as np

from heron.learning.episodes import EpisodeTally, TrainingEpisode, episode
from heron.learning.policy import POLICY, scaled
from heron.learning.runs import TrainingRun, environment
from heron.learning.step_learners import SkrlLearner
from heron.variants import LearningArm

COUNT = 32
"""Environments that learn at once."""


class StepTraining:
    """The environments of a training, and its learner."""

    def __init__(self, run: TrainingRun) -> None:
        self._run = run
        self._envs = [environment(run.formulation, run.arm) for _ in range(COUNT)]
        one: Any = self._envs[0]
        self._learner = SkrlLearner(run.algorithm, one.action_space, COUNT, run.seed)
        self.steps = 0

    def episodes(self) -> Iterator[TrainingEpisode]:
        """Learn until all environments together have used the steps of the budget, and report each
        episode. Times are processor times since this call.
        """
        began = time.process_time()
        seen = np.array([env.reset(seed=self._seed(i))[0] for i, env in enumerate(self._envs)])
        going = [EpisodeTally() for _ in self._envs]
        while self.steps < self._run.budget:
            proposed = self._learner.act(scaled(seen))
            taken = [env.step(each) for env, each in zip(self._envs, proposed, strict=True)]
            following, rewards, terminated, truncated, infos = zip(*taken, strict=True)
            ended = np.array(terminated) | np.array(truncated)
            self._learner.learn(
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
                    yield going[i].episode(self.steps, time.process_time() - began, info["outcome"])
                    going[i] = EpisodeTally()
                    seen[i] = self._envs[i].reset()[0]

    def save(self) -> bytes:
        """The state of the training, for a later continuation."""
        return self._learner.save(self.steps)

    def load(self, kept: bytes) -> None:
        """Continue from a saved state, with new episodes. Raises `ValueError` if the state belongs
        to another training.
        """
        self.steps = self._learner.load(kept)

    def final_episode(self, env: gymnasium.Env[Any, Any], seed: int) -> TrainingEpisode:
        """An episode with the best actions."""
        return episode(env, self._learner.policy(), seed)

    def result(self) -> tuple[str, bytes]:
        """Name and content of a file with the learned values."""
        return POLICY, self._learner.policy().file()

    def _seed(self, number: int) -> int:
        """The seed of an environment. A continued training uses other seeds."""
        return (self._run.seed * 1_000_003 + self.steps) * COUNT + number

    def _own(self, proposed: Any, infos: Sequence[Any]) -> Any:
        """The actions that the learner takes for its own."""
        if self._run.arm is not LearningArm.EXECUTED:
            return proposed
        return np.array([info["guard"]["executed"] for info in infos])
