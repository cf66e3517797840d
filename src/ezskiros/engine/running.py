"""The running skills: a compound skill, and its children that have started and not ended."""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from ezskiros.skills.interface import SkillInterface


@dataclass(frozen=True, eq=False)
class Running:
    """A running skill. `goal` identifies this run, `since` is its start time by the engine's clock
    (s), `values` are the current values of its parameters.
    """

    skill: SkillInterface
    goal: str
    since: float
    values: Callable[[], Mapping[str, Any]]


def with_values_of_now(running: Iterable[Running]) -> list[Running]:
    """The same skills with their current values, because the object that ran them may run other
    skills later.
    """
    return [replace(each, values=partial(dict, each.values())) for each in running]


class RunningSkills:
    """All running skills, in the order of their starts. The ticking thread calls `changed` after
    each start and end.
    """

    def __init__(self, changed: Callable[[], None] = lambda: None) -> None:
        self.changed = changed
        self._running: dict[object, Running] = {}
        # Goals of different processes differ, also after a restart.
        self._own = os.urandom(8).hex()
        self._numbers = itertools.count(1)

    def start(
        self,
        owner: object,
        skill: SkillInterface,
        since: float,
        values: Callable[[], Mapping[str, Any]],
    ) -> None:
        """Record the start of a skill, before any motion. `owner` is the engine object that runs
        it.
        """
        goal = f"{self._own}-{next(self._numbers)}"
        self._running[owner] = Running(skill, goal, since, values)
        self.changed()

    def end(self, owner: object) -> None:
        """Record the end of a skill, if it runs at all. The skill no longer moves anything."""
        if self._running.pop(owner, None) is not None:
            self.changed()

    def __iter__(self) -> Iterator[Running]:
        return iter(list(self._running.values()))
