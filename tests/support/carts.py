"""A cart before a wall as an environment of Gymnasium, and the rules that hold it back."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from gymnasium import Env, spaces

RULES = """
system cell {
    topic /cart/speed : geometry_msgs/Twist;
    node policy { publishes /cart/speed; }
}
input wall = topic /range : sensor_msgs/Range .range timeout 0.5 sec;
action creep { limit /cart/speed { linear.x in [-0.3, 0.05] m/s; }; }
action stop { block /cart/speed; } latched until reset;
rule close: if wall < 0.6 m then { creep; } feedback 1 per activation, 5 per sec,
    margin in mm;
rule at_wall: if wall < 0.3 m then { stop; };
"""
PERIOD_NS = 100_000_000
CHOICES = [-0.3, 0.0, 0.05, 0.5]
OBSERVE = {"wall": (0, "mm")}
ACT = {"linear.x": 0}


class Cart(Env[Any, Any]):
    """Drives to a wall, and sees its distance in mm and its place in m: for `steps` steps, or until
    it hits the wall. Its actions are, by `kind`, a speed in m/s, a choice of speeds, or a place. In
    the midst of each step something comes as close as `dips` say, one after the other.
    """

    def __init__(
        self,
        *,
        start: float = 1.0,
        steps: int = 20,
        kind: str = "speed",
        dtype: Any = np.float32,
        as_dictionary: bool = False,
    ) -> None:
        seen = spaces.Box(-np.inf, np.inf, (2,), np.float64)
        self._as_dictionary = as_dictionary
        self.observation_space = spaces.Dict({"range": seen}) if as_dictionary else seen
        self.action_space = (
            spaces.Discrete(len(CHOICES)) if kind == "choice" else spaces.Box(-2, 2, (1,), dtype)
        )
        self._kind = kind
        self._start = start
        self._steps = steps
        self.executed: list[float] = []
        self.dips: list[float] = []
        self.on_substep: Callable[[Any], None] | None = None
        self._distance = start
        self._taken = 0

    def _seen(self) -> Any:
        seen = np.array([1000.0 * self._distance, self._start - self._distance])
        return {"range": seen} if self._as_dictionary else seen

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        super().reset(seed=seed, options=options)
        self._distance = self._start
        self._taken = 0
        return self._seen(), {}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        match self._kind:
            case "choice":
                speed = CHOICES[int(action)]
            case "place":
                speed = (float(action[0]) - (self._start - self._distance)) * 10.0
            case _:
                speed = float(action[0])
        self.executed.append(speed)
        for dip in self.dips:
            assert self.on_substep is not None
            self.on_substep(np.array([1000.0 * dip, 0.0]))
        self._distance -= 0.1 * speed
        self._taken += 1
        hit = self._distance <= 0.0
        return self._seen(), speed, hit, not hit and self._taken >= self._steps, {}
