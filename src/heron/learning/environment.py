"""The task as environments of Gymnasium: `heron/PegInHole-v1` for commands, and
`heron/PegInHoleMoves-v1` for a choice of moves.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces

from heron.learning.arm import ArmCommand
from heron.learning.insertion import FIELDS, PERIOD_NS, Insertion, TaskParameters
from heron.learning.look import Look
from heron.scene.insertion import InsertionParameters

FASTEST = 0.3
"""The greatest velocity that can be commanded along each axis (m/s)."""
STRONGEST = 10.0
"""The greatest force with which the peg can be pushed down (N)."""
LEAST = np.array([-FASTEST, -FASTEST, -FASTEST, -STRONGEST], np.float32)
GREATEST = np.array([FASTEST, FASTEST, FASTEST, STRONGEST], np.float32)
"""The bounds of an action: velocities along x, y and z (m/s), and the force along z (N). An upward
force is ignored.
"""
_SIZE = (640, 400)  # pixels
_FAST, _SLOW, _PUSH = 0.2, 0.03, -8.0
MOVES: tuple[tuple[float, float, float, float], ...] = (
    (0.0, 0.0, 0.0, 0.0),
    *(
        (speed * (axis == 0), speed * (axis == 1), speed * (axis == 2), 0.0)
        for size in (_FAST, _SLOW)
        for axis in range(3)
        for speed in (-size, size)
    ),
    (0.0, 0.0, 0.0, _PUSH),
)
"""The choices of `heron/PegInHoleMoves-v1`, as numbers of an action: to stand, to move along an
axis, fast or slowly, and to push. All rules let a hand stand.
"""


class PegInHole(gymnasium.Env[Any, Any]):
    """A step policy on Cartesian velocities, and a push. The reward is the distance by which the
    peg comes nearer to its goal, in decimeters, plus 10 for the insertion, which ends the episode.
    Each step costs 0.01.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 10**9 // PERIOD_NS}  # noqa: RUF012  # as Env has it

    def __init__(
        self, *, clearance: float = 0.003, error: float = 0.0005, render_mode: str | None = None
    ) -> None:
        """`clearance` is the difference of the widths of hole and peg (m); `error` is the standard
        deviation of where the robot believes the hole, in the plane (m). `render_mode` is None or
        "rgb_array". Raises `ValueError` for others.
        """
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(f'`render_mode` is None or "rgb_array", not {render_mode!r}')
        self.render_mode = render_mode
        self._look: Look | None = None
        scene = InsertionParameters(clearance=clearance)
        self.insertion = Insertion(TaskParameters(scene, error))
        highest = np.full(len(FIELDS), np.inf)
        self.observation_space = spaces.Box(-highest, highest, dtype=np.float64)
        self.action_space: spaces.Space[Any] = spaces.Box(LEAST, GREATEST)
        self.on_reading: list[Callable[[Any], object]] = []
        """Called with each observation within a step."""

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begin an episode; `options` is not used."""
        super().reset(seed=seed, options=options)
        self.insertion.begin(self.np_random)
        self._far = self._distance()
        return self.insertion.observation(), {}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Follow an action for 40 ms, as far as its numbers are in the space. Raises `ValueError`
        for numbers that are not finite.
        """
        insertion = self.insertion
        insertion.step(self.command(action), self._tell)
        before, self._far = self._far, self._distance()
        inserted = insertion.outcome.inserted
        reward = 10.0 * (before - self._far) - 0.01 + 10.0 * inserted
        info = {"outcome": insertion.outcome} if inserted or insertion.is_over else {}
        return insertion.observation(), reward, inserted, insertion.is_over, info

    def render(self) -> Any:
        """A picture of the present state, of shape (height, width, 3), or None if no `render_mode`
        was asked for. Raises `CannotDrawError` where MuJoCo cannot draw; without a display it needs
        `MUJOCO_GL=egl` in its surroundings before it is imported.
        """
        if self.render_mode is None:
            return None
        if self._look is None:
            self._look = Look(self.insertion, _SIZE)
        return self._look.picture()

    def close(self) -> None:
        """Release the resources for pictures."""
        if self._look is not None:
            self._look.close()
            self._look = None

    def command(self, action: Any) -> ArmCommand:
        """The command of an action. Raises `ValueError` like `step`."""
        if not np.isfinite(action).all():
            raise ValueError(f"an action has four finite numbers, not {action}")
        x, y, z, push = np.clip(np.asarray(action, np.float64), LEAST, GREATEST).tolist()
        return ArmCommand((x, y, z), min(push, 0.0))

    def _tell(self) -> None:
        observation = self.insertion.observation()
        for each in self.on_reading:
            each(observation)

    def _distance(self) -> float:
        """The path from the peg to its goal: first above the hole, then down (m)."""
        offset = self.insertion.arm.place - self.insertion.goal
        return float(np.hypot(offset[0], offset[1]) + abs(offset[2]))


class PegInHoleMoves(PegInHole):
    """The same task by a choice from `MOVES` in each step."""

    def __init__(self, **parameters: Any) -> None:
        """The parameters are the parameters of `PegInHole`."""
        super().__init__(**parameters)
        self.action_space = spaces.Discrete(len(MOVES))

    def command(self, action: Any) -> ArmCommand:
        """The command of a move."""
        return super().command(MOVES[action])
