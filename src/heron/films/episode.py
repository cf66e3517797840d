"""Clips of the experiments."""

from __future__ import annotations

import enum
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from heron.appearance import Pixels, Size
from heron.experiments import USUAL, EpisodeFacts, Experiment
from heron.experiments.experiment import ARM_NAMES
from heron.films.clip import ACTIVE, DONE, MUTED, NO_WORDS, Caption, Words, time_words, with_caption
from heron.films.film import Film
from heron.films.rules_watch import RulesWatch, Spans
from heron.tasks.tree import running_of
from heron.variants import ExperimentArm

_LATELY_S = 0.15
_NEARLY = 0.98  # of a limit counts as reached


@dataclass(frozen=True)
class EpisodeClip:
    """One episode of an experiment, over."""

    experiment: Experiment
    episode: EpisodeFacts
    film: Film
    rules: Spans

    @property
    def duration(self) -> float:
        """The length of the episode (s)."""
        return self.episode.measures.duration

    @property
    def opening(self) -> float:
        """The instant (s) with most to see."""
        return self.experiment.opening_of([self.episode.onsets])

    def pictures(self, times: Sequence[float], speed: float, size: Size) -> Iterable[Pixels]:
        """Pictures at these times (s), with the words below each. Raises `CannotDrawError`."""
        cameras = self.experiment.cameras
        for time, pixels in zip(times, self.film.pictures(cameras, times, size), strict=True):
            yield with_caption(pixels, self._caption(time, speed))

    def _caption(self, time: float, speed: float) -> Caption:
        name = ARM_NAMES[self.episode.arm]
        if time >= self.duration:
            is_done = self.episode.measures.is_completed
            words = f"{'completed' if is_done else 'not completed'} after {self.duration:.1f} s"
            return Caption(name, (words, DONE if is_done else ACTIVE))
        skills = running_of(self.episode.tree, self.duration)
        running = ", ".join(name for name, start, end in skills if start <= time < end)
        active = [
            rule
            for rule, spans in self.rules.items()
            if any(start <= time < end for start, end in spans)
        ]
        timed = time_words(time, speed)
        return Caption(name, timed, (running, MUTED), self._signal(time), active)

    def _signal(self, time: float) -> Words:
        """The most of the signal that is reported, in the last moments, and whether that reaches
        its limit; nothing after its end.
        """
        signal = next(one for one in self.experiment.signals if one.short)
        trace = self.episode.trace
        lately = (trace.times > time - _LATELY_S) & (trace.times <= time)
        if time > trace.times[-1] or not lately.any():
            return NO_WORDS
        value = signal.factor * float(trace.columns[signal.column][lately].max())
        digits = 2 if signal.limit is not None and signal.limit < 1 else 0
        is_beyond = signal.limit is not None and value >= _NEARLY * signal.limit
        words = f"{signal.short} {round(value, digits) + 0.0:.{digits}f} {signal.unit}"
        return words, ACTIVE if is_beyond else MUTED


def film_of(
    experiment: Experiment, variant: enum.Enum, arm: ExperimentArm, seed: int
) -> EpisodeClip:
    """Run an episode, and keep the data for pictures."""
    film, rules = Film(), RulesWatch()
    episode = experiment.run(arm, variant, seed, (film, rules), USUAL)
    return EpisodeClip(experiment, episode, film, rules.spans())
