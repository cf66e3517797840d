"""A training from start to result row: its log, its checkpoints, the learned policy, and the
performance of the policy with and without the guard.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Protocol

import gymnasium

from dslkit.campaign import Value
from dslkit.writing import write_whole
from heron.learning.episodes import EpisodeLog, TrainingEpisode
from heron.learning.runs import TrainingRun, environment, run_of
from heron.learning.summary import row_of
from heron.variants import Formulation, LearningArm

LOG, CHECKPOINT = "episodes.csv", "checkpoint"
FINAL = 50
"""Episodes with the learned values, with and without the guard."""
_FINAL_SEED = 1_000_000
_EVERY = 16_000
"""Steps from one checkpoint to the next."""


class Training(Protocol):
    """A learner and its environments."""

    steps: int

    def episodes(self) -> Iterator[TrainingEpisode]:
        """Learn until the budget is used, and report each episode."""

    def save(self) -> bytes:
        """The state of the training, for a later continuation."""

    def load(self, kept: bytes) -> None:
        """Continue from a saved state. Raises `ValueError` for any other object."""

    def final_episode(self, env: gymnasium.Env[Any, Any], seed: int) -> TrainingEpisode:
        """An episode with the learned values."""

    def result(self) -> tuple[str, bytes]:
        """Name and content of a file with the learned values."""


def train(folder: Path, key: str) -> Value:
    """Run the training of a key, or continue it, and return its row. Raises `OSError`, and
    `ValueError` if its checkpoint or its log belongs to another training.
    """
    run = run_of(key)
    place = folder / run.folder
    place.mkdir(parents=True, exist_ok=True)
    training, checkpoint = _new(run), place / CHECKPOINT
    if checkpoint.exists():
        try:
            training.load(checkpoint.read_bytes())
        except ValueError:
            raise ValueError(f"{checkpoint} belongs to another training; remove it") from None
    log = EpisodeLog(place / LOG, training.steps)
    before = log.episodes[-1].seconds if log.episodes else 0.0
    saved = training.steps
    for episode in training.episodes():
        log.append(episode._replace(seconds=before + episode.seconds))
        if training.steps - saved >= _EVERY:
            write_whole(checkpoint, training.save())
            saved = training.steps
    name, content = training.result()
    write_whole(place / name, content)
    checkpoint.unlink(missing_ok=True)
    return row_of(run, log.episodes, _finals(run, training))


def _new(run: TrainingRun) -> Training:
    """Each learner imports its own library, because one library may be enough."""
    if run.formulation is Formulation.TREE:
        from heron.learning.tree_training import TreeTraining

        return TreeTraining(run)
    from heron.learning.step_training import StepTraining

    return StepTraining(run)


def _finals(run: TrainingRun, training: Training) -> Mapping[LearningArm, list[TrainingEpisode]]:
    found = {}
    for arm in (LearningArm.GUARD, LearningArm.UNGUARDED):
        env = environment(run.formulation, arm)
        seeds = range(_FINAL_SEED, _FINAL_SEED + FINAL)
        found[arm] = [training.final_episode(env, seed) for seed in seeds]
    return found
