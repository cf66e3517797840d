"""An episode as it is shown in a film: its pictures, and the words below them."""

from __future__ import annotations

import enum
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib as mpl
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from heron.experiments import USUAL, Episode, Experiment
from heron.experiments.experiment import ARM_NAMES
from heron.films.film import Film, Pixels, Size
from heron.films.rules_watch import RulesWatch, Spans
from heron.tasks.tree import running_of
from heron.variants import Arm

STRIP = 62
"""The height of the words (pixels)."""
_LINES = (5, 23, 41)
_LATELY_S = 0.15
_NEARLY = 0.98  # of a limit counts as reached
_LETTERS = 13
_MARGIN = 10
_PAPER, _INK, _MUTED = (255, 255, 255), (29, 35, 41), (98, 108, 118)
_DONE, _ACTIVE = (11, 127, 100), (207, 79, 23)
_FOLDER = Path(mpl.get_data_path()) / "fonts" / "ttf"
_PLAIN = ImageFont.truetype(str(_FOLDER / "DejaVuSans.ttf"), _LETTERS)
_BOLD = ImageFont.truetype(str(_FOLDER / "DejaVuSans-Bold.ttf"), _LETTERS)


@dataclass(frozen=True)
class Clip:
    """One episode of an experiment, over."""

    experiment: Experiment
    episode: Episode
    film: Film
    rules: Spans

    @property
    def duration(self) -> float:
        """The length of the episode (s)."""
        return self.episode.measures.duration

    def pictures(self, times: Sequence[float], speed: float, size: Size) -> Iterable[Pixels]:
        """Pictures at these times (s), with the words below each. Raises `CannotDrawError`."""
        skills = running_of(self.episode.tree, self.duration)
        cameras = self.experiment.cameras
        for time, pixels in zip(times, self.film.pictures(cameras, times, size), strict=True):
            running = ", ".join(name for name, start, end in skills if start <= time < end)
            active = ", ".join(
                rule
                for rule, spans in self.rules.items()
                if any(start <= time < end for start, end in spans)
            )
            yield np.vstack((pixels, self._strip(time, speed, running, active, size[0])))

    def _strip(self, time: float, speed: float, running: str, active: str, width: int) -> Pixels:
        strip = Image.new("RGB", (width, STRIP), _PAPER)
        draw = ImageDraw.Draw(strip)
        right = width - _MARGIN
        draw.text((_MARGIN, _LINES[0]), ARM_NAMES[self.episode.arm], _INK, _BOLD)
        if time >= self.duration:
            is_done = self.episode.measures.is_completed
            words = f"{'completed' if is_done else 'not completed'} after {self.duration:.1f} s"
            color = _DONE if is_done else _ACTIVE
            draw.text((right, _LINES[0]), words, color, _PLAIN, anchor="ra")
        else:
            words = f"{time:.1f} s" if speed == 1 else f"{time:.1f} s, {speed:g} times as fast"
            draw.text((right, _LINES[0]), words, _MUTED, _PLAIN, anchor="ra")
            draw.text((_MARGIN, _LINES[1]), running, _MUTED, _PLAIN)
            words, is_beyond = self._signal(time)
            color = _ACTIVE if is_beyond else _MUTED
            draw.text((right, _LINES[1]), words, color, _PLAIN, anchor="ra")
            draw.text((_MARGIN, _LINES[2]), active, _ACTIVE, _PLAIN)
        return np.asarray(strip)

    def _signal(self, time: float) -> tuple[str, bool]:
        """The most of the signal that is told, in the last moments, and whether that reaches its
        limit; nothing after its end.
        """
        signal = next(one for one in self.experiment.signals if one.short)
        trace = self.episode.trace
        lately = (trace.times > time - _LATELY_S) & (trace.times <= time)
        if time > trace.times[-1] or not lately.any():
            return "", False
        value = signal.factor * float(trace.columns[signal.column][lately].max())
        digits = 2 if signal.limit is not None and signal.limit < 1 else 0
        is_beyond = signal.limit is not None and value >= _NEARLY * signal.limit
        return f"{signal.short} {round(value, digits) + 0.0:.{digits}f} {signal.unit}", is_beyond


def film_of(experiment: Experiment, variant: enum.Enum, arm: Arm, seed: int) -> Clip:
    """Run an episode, and keep what there is to see."""
    film, rules = Film(), RulesWatch()
    episode = experiment.run(arm, variant, seed, (film, rules), USUAL)
    return Clip(experiment, episode, film, rules.spans())
