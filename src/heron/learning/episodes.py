"""Episodes of a training: their counters, and their log."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import gymnasium
import numpy as np
from numpy.typing import NDArray

from heron.learning.insertion import VIOLATIONS, InsertionOutcome


class TrainingEpisode(NamedTuple):
    """An episode of a training. `steps` are the steps of all environments before its end, with the
    processor time since the beginning of the training (s). `proposed_outside` counts the steps
    whose proposed command the rules would change. `executed_outside` counts the steps in which such
    a command was executed. Forces are in N, speeds in m/s.
    """

    steps: int
    seconds: float
    length: int
    reward: float
    proposed_outside: int
    executed_outside: int
    inserted: int
    touched: int
    too_hard: int
    near_person: int
    broken: int
    greatest_touch: float
    greatest_force: float
    fastest_near_person: float

    @property
    def is_violating(self) -> bool:
        """Say whether something happened that must not."""
        return bool(self.touched or self.too_hard or self.near_person)


@dataclass
class EpisodeTally:
    """The counts of a running episode, with the names of `TrainingEpisode`."""

    length: int = 0
    reward: float = 0.0
    proposed_outside: int = 0
    executed_outside: int = 0

    def count(self, reward: float, reported: Any) -> None:
        """Take a step into account."""
        self.length += 1
        self.reward += reward
        self.proposed_outside += reported["intervened"]
        is_executed = bool(np.all(reported["executed"] == reported["proposed"]))
        self.executed_outside += reported["intervened"] and is_executed

    def episode(self, steps: int, seconds: float, outcome: InsertionOutcome) -> TrainingEpisode:
        """The episode, which is over."""
        found = {name: int(name in outcome.violations) for name in VIOLATIONS}
        return TrainingEpisode(
            steps=steps,
            seconds=seconds,
            length=self.length,
            reward=self.reward,
            proposed_outside=self.proposed_outside,
            executed_outside=self.executed_outside,
            inserted=int(outcome.inserted),
            broken=int(outcome.broken),
            greatest_touch=outcome.greatest_touch,
            greatest_force=outcome.greatest_force,
            fastest_near_person=outcome.fastest_near_person,
            **found,
        )


def episode(
    env: gymnasium.Env[Any, Any], act: Callable[[NDArray[np.float64]], Any], seed: int
) -> TrainingEpisode:
    """Run an episode. `act` gives an action for each observation."""
    began, tally = time.process_time(), EpisodeTally()
    seen, _ = env.reset(seed=seed)
    while True:
        seen, reward, terminated, truncated, info = env.step(act(seen))
        tally.count(float(reward), info["guard"])
        if terminated or truncated:
            elapsed = time.process_time() - began
            return tally.episode(tally.length, elapsed, info["outcome"])


class EpisodeLog:
    """A CSV file that gets a line at the end of each episode, to be looked at meanwhile."""

    def __init__(self, path: Path, steps: int) -> None:
        """Continue an existing log, after this number of steps. Raises `OSError`."""
        self._path = path
        self.episodes = [one for one in read_log(path) if one.steps <= steps]
        lines = [",".join(TrainingEpisode._fields), *map(_line, self.episodes)]
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")

    def append(self, episode: TrainingEpisode) -> None:
        """Write an episode."""
        self.episodes.append(episode)
        with self._path.open("a", encoding="utf-8") as file:
            file.write(_line(episode) + "\n")


def read_log(path: Path) -> list[TrainingEpisode]:
    """The episodes of a log; none if there is no log. A last line in which a program was
    interrupted counts for nothing. Raises `OSError`, and `ValueError` if another line is none.
    """
    if not path.exists():
        return []
    text = path.read_text(encoding="utf-8", errors="replace")
    try:
        return episodes_of(text[: text.rfind("\n") + 1].splitlines()[1:])
    except ValueError:
        raise ValueError(f"{path} is not a log of episodes; remove its folder") from None


def episodes_of(lines: Iterable[str]) -> list[TrainingEpisode]:
    """The episodes of lines of a log. Raises `ValueError` if a line is none."""
    return [_episode(line.split(",")) for line in lines]


def _episode(texts: Sequence[str]) -> TrainingEpisode:
    if len(texts) != len(TrainingEpisode._fields):
        raise ValueError("this is not an episode")
    return TrainingEpisode._make(map(_number, texts))


def _number(text: str) -> float:
    return int(text) if text.isdigit() else float(text)


def _line(episode: TrainingEpisode) -> str:
    return ",".join(
        f"{value:.6g}" if isinstance(value, float) else str(int(value)) for value in episode
    )
