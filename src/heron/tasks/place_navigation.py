"""Navigation between the places of a map."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from heron.goals import Goal
from heron.tasks.navigation import Navigation, NavigationParameters, Point
from heron.topics import Carrier


class PlaceNavigation(Navigation):
    """Drives to a place by the first of its routes, and after `replan` by the next route."""

    def __init__(
        self,
        carrier: Carrier,
        routes: Mapping[str, Sequence[Sequence[Point]]],
        parameters: NavigationParameters,
        clock: Callable[[], int],
        is_blocked: Callable[[], bool],
    ) -> None:
        """`routes` has those that lead to each place, without the point where they begin: that is
        where the robot is.
        """
        super().__init__(carrier, (), parameters, clock, is_blocked)
        self._known = routes

    def send(self, goal: Goal, done: Callable[[bool], None]) -> None:
        """A robot that knows neither the place nor where it is itself does not get there."""
        routes = self._known.get(str(goal["place"]), ())
        if self._pose is None or not routes:
            done(False)
            return
        self._routes = [[self._pose[:2], *points] for points in routes]
        self._next = 1
        super().send(goal, done)
