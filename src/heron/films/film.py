"""A film of an episode. The states are stored during the episode and drawn after it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import closing
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np

from heron.appearance import Camera, Canvas, Pixels, Size, Stage, VisibleState, moment_of
from heron.experiments import SimulatedNode
from heron.guard import Guard
from heron.robot.physics import Physics
from heron.topics import InProcess

PERIOD_NS = 50_000_000
_UNSEEN = 0.0012  # of the distance of the camera: half of a pixel


class _Reel(NamedTuple):
    """The moments of one scene."""

    spec: Any
    moments: list[VisibleState]


class Film:
    """The moments of an episode, one in each period. As an observer, it collects the moments."""

    def __init__(self, period_ns: int = PERIOD_NS) -> None:
        self.period_ns = period_ns
        self._reels: list[_Reel] = []
        self._physics: Physics | None = None

    def begin(self, spec: Any) -> None:
        """Continue in another scene."""
        self._reels.append(_Reel(spec, []))

    def keep(self, moment: VisibleState) -> None:
        """Append a moment."""
        self._reels[-1].moments.append(moment)

    def attend(
        self,
        physics: Physics,
        carrier: InProcess,  # noqa: ARG002
        guard: Guard | None,  # noqa: ARG002
    ) -> Sequence[SimulatedNode]:
        """Look on."""
        self._physics = physics
        self.begin(physics.spec)
        return [self]

    def tick(self, now_ns: int) -> None:  # noqa: ARG002
        """Store the visible state."""
        assert self._physics is not None
        self.keep(moment_of(self._physics.data))

    @property
    def duration(self) -> float:
        """The length of all scenes (s)."""
        return sum(len(reel.moments) for reel in self._reels) * self.period_ns * 1e-9

    def pictures(
        self, cameras: Sequence[Camera], times: Sequence[float], size: Size
    ) -> Iterator[Pixels]:
        """Pictures at these times (s), each scene as its camera sees it. After the end the last one
        stays. Raises `CannotDrawError`.
        """
        for scene, indices in groupby(map(self._place, times), key=lambda place: place[0]):
            reel = self._reels[scene]
            moments = [reel.moments[index] for _, index in indices]
            yield from _drawn(Stage(reel.spec), moments, cameras[scene], size)

    def _place(self, time: float) -> tuple[int, int]:
        """The scene of an instant (s), and the number of its moment there."""
        index = round(time * 1e9 / self.period_ns)
        for scene, reel in enumerate(self._reels):
            if index < len(reel.moments):
                return scene, index
            index -= len(reel.moments)
        return len(self._reels) - 1, -1


def _drawn(
    stage: Stage, moments: Sequence[VisibleState], camera: Camera, size: Size
) -> Iterator[Pixels]:
    """One picture for each moment. A picture without motion is drawn once."""
    width, height = size
    with closing(Canvas(stage, camera, size)) as canvas:
        before, pixels = None, np.zeros((height, width, 3), np.uint8)
        for moment in moments:
            stage.show(moment)
            places = stage.places()
            if before is None or np.abs(places - before).max() > _UNSEEN * camera.distance:
                before, pixels = places, canvas.draw()
            yield pixels
