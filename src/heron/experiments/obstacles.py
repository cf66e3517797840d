"""The obstacles of experiments VI and VII. Each blocks a route, either permanently or until a
person removes it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from heron.robot import Base
from heron.scene import PathsParameters, StraightPath
from heron.variants import Blockage, Trouble

_NEAR = 1.8  # m from middle to middle: the base is about to stand before it
_ASIDE = 3.0  # m, to where it is taken
_PACE = 0.8  # m/s, at which a person pushes a trolley
_IN_THE_WAY = 1.2  # m: the sideways distance at which it no longer blocks the base
_ON_PATH = 0.75  # m beside the center of a path
_BEGIN = 0.3  # m; a base so near the beginning of a path has left it
_TROUBLES = {
    Trouble.LASTING: Blockage.PALLET,
    Trouble.PASSING: Blockage.TROLLEY,
    Trouble.NONE: None,
}
OFTEN = 0.8
"""The share of the runs with an obstacle, for variants with obstacles."""


@dataclass(frozen=True)
class Obstacle:
    """An obstacle across a path, `along` m from its beginning. `stay_s` is the time after which it
    is removed, from the arrival of the base; if it is None, the obstacle stays. `side` is the
    direction of the removal: 1 is to the left of the path, -1 to the right.
    """

    name: str
    path: StraightPath
    along: float
    side: int
    stay_s: float | None


def varied(
    blockage: Blockage, paths: PathsParameters, generator: np.random.Generator
) -> tuple[Obstacle, ...]:
    """The part that differs from seed to seed: where obstacles stand, and for how long."""
    first, second = (float(generator.uniform(4.0, 8.0)) for _ in range(2))
    stay_s, later_s = (float(generator.uniform(3.0, 8.0)) for _ in range(2))
    pallet = Obstacle("pallet", paths.first, first, 1, None)
    if blockage is Blockage.PALLET:
        return (pallet,)
    if blockage is Blockage.TROLLEY:
        return (Obstacle("trolley", paths.first, first, 1, stay_s),)
    return pallet, Obstacle("trolley", paths.second, second, -1, later_s)


def troubled(
    trouble: Trouble, paths: PathsParameters, generator: np.random.Generator
) -> tuple[Obstacle, ...]:
    """The obstacle of experiment VII, if there is one. In `OFTEN` of the runs it stands across the
    first path, as in experiment VI.
    """
    blockage = _TROUBLES[trouble]
    is_there = bool(generator.random() < OFTEN)
    return () if blockage is None or not is_there else varied(blockage, paths, generator)


@dataclass
class _State:
    """The instants (ns) of the arrival of the base at an obstacle and of the beginning of its
    removal, and the distance of the obstacle from the path (m).
    """

    near_ns: int | None = None
    taken_ns: int | None = None
    aside: float = 0.0


@dataclass
class Obstacles:
    """Stand, and are taken aside."""

    physics: Base
    obstacles: Sequence[Obstacle]
    period_ns: int = field(default=20_000_000, init=False)

    def __post_init__(self) -> None:
        self._states = [_State() for _ in self.obstacles]
        self.tick(0)

    @property
    def is_blocked(self) -> bool:
        """The base is on a path, and has come near an obstacle on it."""
        return any(
            state.near_ns is not None
            and state.aside < _IN_THE_WAY
            and self._is_on(each.path, each.along)
            for each, state in zip(self.obstacles, self._states, strict=True)
        )

    def take_away(self, now_ns: int) -> None:
        """Remove the obstacle at which the base has arrived."""
        for state in self._states:
            if state.near_ns is not None and state.taken_ns is None:
                state.taken_ns = now_ns

    def tick(self, now_ns: int) -> None:
        """A moment later."""
        for each, state in zip(self.obstacles, self._states, strict=True):
            self._note(each, state, now_ns)
            if state.taken_ns is not None:
                state.aside = min(_ASIDE, _PACE * (now_ns - state.taken_ns) * 1e-9)
            self._put(each, state.aside)

    def _note(self, each: Obstacle, state: _State, now_ns: int) -> None:
        """Check if the base has arrived, or if it is time to remove the obstacle."""
        here = self.physics.position[:2]
        if state.near_ns is None and math.dist(here, each.path.at(each.along)) < _NEAR:
            state.near_ns = now_ns
        if each.stay_s is None or state.near_ns is None or state.taken_ns is not None:
            return
        if now_ns - state.near_ns >= each.stay_s * 1e9:
            state.taken_ns = now_ns

    def _is_on(self, path: StraightPath, until: float) -> bool:
        x, y, _ = self.physics.position.tolist()
        along, left = path.beside((x, y))
        return _BEGIN < along < until and abs(left) < _ON_PATH

    def _put(self, each: Obstacle, aside: float) -> None:
        half = each.path.heading / 2
        index = self.physics.model.body(each.name).mocapid[0]
        self.physics.data.mocap_pos[index] = (*each.path.at(each.along, each.side * aside), 0.0)
        self.physics.data.mocap_quat[index] = (math.cos(half), 0.0, 0.0, math.sin(half))
