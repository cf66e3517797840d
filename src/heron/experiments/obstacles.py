"""The obstacles of experiments VI and VII. Each blocks a route, either permanently or until a
person removes it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from heron.robot import Base
from heron.scene import Way, WaysParameters
from heron.variants import Blockage, Trouble

_NEAR = 1.8  # m from middle to middle: the base is about to stand before it
_ASIDE = 3.0  # m, to where it is taken
_PACE = 0.8  # m/s, at which somebody pushes a trolley
_IN_THE_WAY = 1.2  # m that it has been taken aside when nothing of it is in the way of the base
_ON_WAY = 0.75  # m beside the middle of a way
_BEGIN = 0.3  # m; who is so near the begin of a way has left it
_TROUBLES = {
    Trouble.LASTING: Blockage.PALLET,
    Trouble.PASSING: Blockage.TROLLEY,
    Trouble.NONE: None,
}
OFTEN = 0.8
"""The share of the runs in which something stands in the way, where there is trouble."""


@dataclass(frozen=True)
class Obstacle:
    """A thing across a way, `along` m from its begin. It is taken away `stay_s` after the base has
    come near, or stays there for good if that is None. `side` says where it is taken: 1 is to the
    left of the way, -1 to the right.
    """

    name: str
    way: Way
    along: float
    side: int
    stay_s: float | None


def varied(
    blockage: Blockage, ways: WaysParameters, generator: np.random.Generator
) -> tuple[Obstacle, ...]:
    """The part that differs from seed to seed: where obstacles stand, and for how long."""
    first, second = (float(generator.uniform(4.0, 8.0)) for _ in range(2))
    stay_s, later_s = (float(generator.uniform(3.0, 8.0)) for _ in range(2))
    pallet = Obstacle("pallet", ways.first, first, 1, None)
    if blockage is Blockage.PALLET:
        return (pallet,)
    if blockage is Blockage.TROLLEY:
        return (Obstacle("trolley", ways.first, first, 1, stay_s),)
    return pallet, Obstacle("trolley", ways.second, second, -1, later_s)


def troubled(
    trouble: Trouble, ways: WaysParameters, generator: np.random.Generator
) -> tuple[Obstacle, ...]:
    """The obstacle of experiment VII, if there is one: in `OFTEN` of the runs it stands across the
    first way, as in experiment VI.
    """
    blockage = _TROUBLES[trouble]
    is_there = bool(generator.random() < OFTEN)
    return () if blockage is None or not is_there else varied(blockage, ways, generator)


@dataclass
class _State:
    """The instants (ns) at which the base came near an obstacle, and at which somebody began to
    take it away; and how far aside it is (m).
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
        """The base is on a way, and has come near an obstacle that still stands there."""
        return any(
            state.near_ns is not None
            and state.aside < _IN_THE_WAY
            and self._is_on(each.way, each.along)
            for each, state in zip(self.obstacles, self._states, strict=True)
        )

    def take_away(self, now_ns: int) -> None:
        """Remove the obstacle that the base has come near."""
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
        """The base comes near, or it is time to take the obstacle away."""
        here = self.physics.position[:2]
        if state.near_ns is None and math.dist(here, each.way.at(each.along)) < _NEAR:
            state.near_ns = now_ns
        if each.stay_s is None or state.near_ns is None or state.taken_ns is not None:
            return
        if now_ns - state.near_ns >= each.stay_s * 1e9:
            state.taken_ns = now_ns

    def _is_on(self, way: Way, until: float) -> bool:
        x, y, _ = self.physics.position.tolist()
        along, left = way.beside((x, y))
        return _BEGIN < along < until and abs(left) < _ON_WAY

    def _put(self, each: Obstacle, aside: float) -> None:
        half = each.way.heading / 2
        index = self.physics.model.body(each.name).mocapid[0]
        self.physics.data.mocap_pos[index] = (*each.way.at(each.along, each.side * aside), 0.0)
        self.physics.data.mocap_quat[index] = (math.cos(half), 0.0, 0.0, math.sin(half))
