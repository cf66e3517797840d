"""The training of the numbers of a behavior tree: CMA-ES (Hansen), from the package cmaes."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import cmaes
import gymnasium
import numpy as np
from numpy.typing import NDArray

from heron.learning.episodes import TrainingEpisode, episode
from heron.learning.runs import TrainingRun, environment
from heron.learning.tree import NUMBERS, RANGES, InsertionTree

_CANDIDATES = 9
"""Sets of numbers in a generation; each is tried in one episode."""
_LEAST = np.array([least for least, _ in RANGES.values()])
_WIDTH = np.array([greatest - least for least, greatest in RANGES.values()])
Floats = NDArray[np.float64]


class TreeTraining:
    """The environment of a training, the tree, and the optimizer of its numbers."""

    def __init__(self, run: TrainingRun) -> None:
        """Raises `FaultyError` if the skills have errors."""
        self._run = run
        self._env = environment(run.formulation, run.arm)
        self._tree = InsertionTree()
        self._optimizer = cmaes.CMA(
            mean=np.random.default_rng(run.seed).uniform(0.1, 0.9, len(RANGES)),
            sigma=0.3,
            bounds=np.array([[0.0, 1.0]] * len(RANGES)),
            seed=run.seed,
            population_size=_CANDIDATES,
        )
        self._scores: list[list[float]] = []
        self.steps = 0

    def episodes(self) -> Iterator[TrainingEpisode]:
        """Try generations until they have used the steps of the budget, and report each episode.
        Times are processor times since this call.
        """
        began = time.process_time()
        while self.steps < self._run.budget:
            candidates, scores, steps = self._candidates(), [], self.steps
            for candidate in candidates:
                act = self._tree.policy(numbers_of(candidate))
                found = episode(self._env, act, self._run.seed * 10**9 + steps)
                steps += found.length
                scores.append(found.reward)
                yield found._replace(steps=steps, seconds=time.process_time() - began)
            self._tell(candidates, scores)
            self.steps = steps

    def save(self) -> bytes:
        """The generations that are over. The optimizer draws the same candidates again."""
        return json.dumps({"steps": self.steps, "scores": self._scores}).encode()

    def load(self, kept: bytes) -> None:
        """Continue from a saved state. Raises `ValueError` for any other object."""
        try:
            found = json.loads(kept)
            scores = [[float(each) for each in one] for one in found["scores"]]
            self.steps = int(found["steps"])
        except (KeyError, TypeError):
            raise ValueError("this is not a list of generations") from None
        if any(len(one) != _CANDIDATES for one in scores):
            raise ValueError("these are generations of another training")
        for one in scores:
            self._tell(self._candidates(), one)

    def best(self) -> Mapping[str, float]:
        """The numbers at the center of the current search."""
        return numbers_of(np.clip(self._optimizer.mean, 0.0, 1.0))

    def final_episode(self, env: gymnasium.Env[Any, Any], seed: int) -> TrainingEpisode:
        """An episode with the best numbers."""
        return episode(env, self._tree.policy(self.best()), seed)

    def result(self) -> tuple[str, bytes]:
        """Name and content of a file with the learned values."""
        return NUMBERS, json.dumps(dict(self.best()), indent=2).encode()

    def _candidates(self) -> list[Floats]:
        return [self._optimizer.ask() for _ in range(_CANDIDATES)]

    def _tell(self, candidates: Sequence[Floats], scores: list[float]) -> None:
        reported = [(each, -score) for each, score in zip(candidates, scores, strict=True)]
        self._optimizer.tell(reported)
        self._scores.append(scores)


def numbers_of(candidate: Floats) -> Mapping[str, float]:
    """The numbers of the tree, each from 0 to 1 within its range."""
    return dict(zip(RANGES, (_LEAST + candidate * _WIDTH).tolist(), strict=True))
