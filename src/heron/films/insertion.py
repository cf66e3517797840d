"""Clips of a robot that is learning, or has learned, to insert a peg. They need
`rossmarie[gym]`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from heron.appearance import Pixels, Size
from heron.films.clip import ACTIVE, DONE, MUTED, NO_WORDS, Caption, time_words, with_caption
from heron.films.film import Film
from heron.learning.arms import ARM_NAMES, is_guarded
from heron.learning.environment import PegInHole
from heron.learning.insertion import FIELDS, PERIOD_NS, InsertionOutcome
from heron.learning.look import CAMERA, moment
from heron.learning.runs import environment
from heron.scene.insertion import build_insertion
from heron.variants import Formulation, LearningArm

Floats = NDArray[np.float64]
Policy = Callable[[Floats], Any]
"""A function from an observation, the numbers of `heron.learning.insertion.FIELDS`, to an action.
"""
_PERIOD_S = PERIOD_NS * 1e-9
_FORCE = slice(FIELDS.index("force.x"), FIELDS.index("force.z") + 1)
_PERSON = FIELDS.index("person")
_HARMS = {
    "touched": "touched the fragile part",
    "too_hard": "pressed too hard",
    "near_person": "too fast near the person",
}


class Shown(NamedTuple):
    """The facts of an instant: the force at the wrist (N), the distance to the person (m), the
    harms until now, and the active rules, with the latest first.
    """

    force: float
    person: float
    harms: tuple[str, ...]
    rules: tuple[str, ...]


@dataclass(frozen=True)
class InsertionClip:
    """One episode of the task, over. There is an instant to show each step, and the first."""

    arm: LearningArm
    outcome: InsertionOutcome
    film: Film
    instants: Sequence[Shown]

    @property
    def duration(self) -> float:
        """The length of the episode (s)."""
        return self.outcome.seconds

    @property
    def opening(self) -> float:
        """The first instant (s) at which something has gone wrong; 0 if nothing has."""
        harmful = (place for place, each in enumerate(self.instants) if each.harms)
        return next(harmful, 0) * _PERIOD_S

    def pictures(self, times: Sequence[float], speed: float, size: Size) -> Iterable[Pixels]:
        """Pictures at these times (s), with the words below each. Raises `CannotDrawError`."""
        for time, pixels in zip(times, self.film.pictures([CAMERA], times, size), strict=True):
            yield with_caption(pixels, self._caption(time, speed))

    def _caption(self, time: float, speed: float) -> Caption:
        title = ARM_NAMES[self.arm]
        if time >= self.duration:
            is_done = self.outcome.inserted
            words = f"{'inserted' if is_done else 'not inserted'} after {self.duration:.1f} s"
            return Caption(title, (words, DONE if is_done else ACTIVE), names=_harms(self.outcome))
        shown = self.instants[round(time / _PERIOD_S)]
        state = f"wrist {shown.force:.0f} N, person {shown.person:.1f} m"
        signal = (shown.harms[0], ACTIVE) if shown.harms else NO_WORDS
        timed, measured = time_words(time, speed), (state, MUTED)
        if is_guarded(self.arm):
            return Caption(title, timed, measured, signal, shown.rules)
        would = [f"would act: {shown.rules[0]}", *shown.rules[1:]] if shown.rules else []
        return Caption(title, timed, measured, signal, would, MUTED)


def film_of_insertion(
    policy: Policy, arm: LearningArm, seed: int, formulation: Formulation = Formulation.STEPS
) -> InsertionClip:
    """Run an episode in an arm of the study, and keep the data for pictures. `write_movie` makes a
    film of one clip, or of several clips side by side.
    """
    env = environment(formulation, arm)
    task = env.unwrapped
    assert isinstance(task, PegInHole)
    names = env.get_wrapper_attr("rules")
    film, insertion = Film(PERIOD_NS), task.insertion
    film.begin(build_insertion(insertion.task.scene))
    seen, _ = env.reset(seed=seed)
    film.keep(moment(insertion))
    instants = [_shown(seen, insertion.outcome, ())]
    is_over = False
    while not is_over:
        seen, _, terminated, truncated, info = env.step(policy(seen))
        active = [name for name, acts in zip(names, info["guard"]["active"], strict=True) if acts]
        film.keep(moment(insertion))
        latest_first = _latest_first(active, instants[-1].rules)
        instants.append(_shown(seen, insertion.outcome, latest_first))
        is_over = terminated or truncated
    return InsertionClip(arm, insertion.outcome, film, instants)


def _latest_first(active: Sequence[str], before: Sequence[str]) -> list[str]:
    """The rules that have become active, and then those that still are."""
    still = [name for name in before if name in active]
    return [name for name in active if name not in before] + still


def _shown(seen: Floats, outcome: InsertionOutcome, active: Sequence[str]) -> Shown:
    force, person = float(np.linalg.norm(seen[_FORCE])), float(seen[_PERSON])
    return Shown(force, person, _harms(outcome), tuple(active))


def _harms(outcome: InsertionOutcome) -> tuple[str, ...]:
    """The harms until now, with the worst first."""
    found = [name for name in _HARMS if name in outcome.violations]
    words = {**_HARMS, "touched": "broke the fragile part"} if outcome.broken else _HARMS
    return tuple(words[name] for name in found)
