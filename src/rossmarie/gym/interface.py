"""The safety interface between a learner and an environment (thesis, section 6.4, figure 5): the
guard processes observations, and limits actions. It serves one environment, or many.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from operator import index as as_index
from os import PathLike
from typing import Any, Literal, NamedTuple, TypeAlias, get_args

import numpy as np
from gymnasium import Space
from numpy.typing import NDArray

from rossmarie.driver.monitor import Monitor, load
from rossmarie.guard import FeedbackMeter, MappingError
from rossmarie.gym.actions import Allows, actions_of
from rossmarie.gym.observations import Array, Observations, Spots
from rossmarie.gym.targets import ActionTargets, with_speeds

Rules: TypeAlias = "str | PathLike[str] | Monitor"
Latched: TypeAlias = Literal["hold", "truncate"]


@dataclass(frozen=True)
class Declarations:
    """All declarations of a user about an environment. `GuardedEnv` describes them."""

    rules: Rules
    period_ns: int
    observe: Spots
    act: Mapping[str, Any]
    latched: Latched
    targets: Mapping[str, Any]
    enforce: bool


class Passed(NamedTuple):
    """One action or several: the proposed actions, the executed actions, and a flag for each. The
    flag is True if the rules have changed the action, or would have changed it.
    """

    proposed: Any
    executed: Any
    intervened: NDArray[np.bool_]


class Interface:
    """Declarations checked against the rules and the spaces of an environment."""

    def __init__(
        self, declared: Declarations, observations: Space[Any], actions: Space[Any]
    ) -> None:
        """Raises `RulesError` for rules with errors, `MappingError` for declarations that do not
        fit.
        """
        self.period_ns = as_index(declared.period_ns)
        if self.period_ns <= 0:
            raise MappingError(f"a period is a positive number of ns, not {self.period_ns}")
        if declared.latched not in get_args(Latched):
            raise MappingError(f'`latched` is "hold" or "truncate", not {declared.latched!r}')
        self.observations = Observations(observations)
        self.actions = actions_of(actions, declared.act)
        self._enforces = declared.enforce
        seen = {
            name: self.observations.number(name, spot) for name, spot in declared.targets.items()
        }
        self.targets = ActionTargets(seen, self.actions.declared, self.period_ns)
        rules = declared.rules
        monitor = rules if isinstance(rules, Monitor) else load(rules)
        self.guard = monitor.guard(
            observe=self.observations.declared(declared.observe),
            act=with_speeds(self.actions.declared, seen),
        )
        self.guard.require_sizes(self.observations.size, self.actions.size)
        self.feedback = FeedbackMeter(self.guard.machine)
        latched = [rule.release is None for rule in monitor.machine.rules]
        self._ending = np.array(latched, np.bool_) & (declared.latched == "truncate")

    def require_substeps(self, substeps: int) -> int:
        """A number of substeps. Raises `MappingError` if a period cannot have this number."""
        if not 0 < as_index(substeps) <= self.period_ns:
            raise MappingError(f"a step has at least one substep, not {substeps}")
        return as_index(substeps)

    def is_over(self, active: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """A mask: True if an active rule truncates the episode."""
        return np.asarray((active & self._ending).any(axis=-1))

    def passed(
        self,
        action: Any,
        decide: Callable[[Array], Array],
        allows: Allows,
        which: NDArray[np.bool_] | None = None,
    ) -> Passed:
        """Pass one action or several, as far as the rules allow. `decide` bounds flat actions. With
        many environments, only those that `which` marks execute their actions.
        """
        proposed = self.actions.flat(action)
        speeds = self.targets.speeds(proposed)
        bounded = self.targets.back(proposed, speeds, decide(speeds))
        allowed = self.actions.executed(action, bounded, allows)
        is_changed = np.asarray((proposed != self.actions.flat(allowed)).any(axis=-1))
        executed = allowed if self._enforces else action
        self.targets.take(self.actions.flat(executed), which)
        return Passed(action, executed, is_changed)
