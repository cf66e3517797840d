"""Navigation: an action server that follows a route to its end, and takes the next route on a
`replan` command.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from heron import messages
from heron.goals import NAVIGATE, Goal
from heron.messages import Message
from heron.tasks.outcome import TaskStatus
from heron.topics import COMMAND, POSE, REPLAN, Carrier

Point = tuple[float, float]


@dataclass(frozen=True)
class NavigationParameters:
    """Rate in Hz, speeds in m/s and rad/s, lengths in m, times in s."""

    rate: float = 20.0
    cruise: float = 0.45
    """A tenth below the 0.5 m/s that the safety rules allow, as a planner is set up."""
    fastest_turn: float = 0.6
    lookahead: float = 0.8
    arrival: float = 0.15
    turn_on_the_spot: float = 0.5
    """The lateral angle of the path (rad) above which the robot turns on the spot."""
    patience: float = 45.0
    """Without progress for this time, the task is given up. An operator comes sooner."""
    progress: float = 0.3


class Navigation:
    """Pure pursuit along a chain of points. `routes` begin where the robot is."""

    def __init__(
        self,
        carrier: Carrier,
        routes: Sequence[Sequence[Point]],
        parameters: NavigationParameters,
        clock: Callable[[], int],
        is_blocked: Callable[[], bool] = lambda: False,
    ) -> None:
        """The base stops while `is_blocked` reports an obstacle ahead."""
        self._is_blocked = is_blocked
        self._routes = [list(route) for route in routes]
        self._parameters = parameters
        self._clock = clock
        self._pose: tuple[float, float, float] | None = None
        self._next = 1
        self._progress_at: Point = (math.inf, math.inf)
        self._progress_ns = 0
        self._command = carrier.publisher(COMMAND)
        self._done: Callable[[bool], None] | None = None
        self.outcome = TaskStatus.RUNNING
        self.replanned = 0
        self.period_ns = round(1e9 / parameters.rate)
        carrier.subscribe(POSE, self._locate)
        carrier.subscribe(REPLAN, self._replan)
        carrier.serve(NAVIGATE, self)

    def send(self, _: Goal, done: Callable[[bool], None]) -> None:
        """Its routes have one end, whatever the goal calls it."""
        self._done = done
        self._progress_ns = self._clock()

    def cancel(self) -> None:
        """The base stays where it is."""
        done, self._done = self._done, None
        if done is not None:
            done(False)

    def tick(self, now_ns: int) -> None:
        """One period later."""
        if self._done is None or self._pose is None:
            self._command(messages.twist(0.0, 0.0))
            return
        self._look_for_progress(now_ns)
        self._pass_points()
        if self._next == len(self._routes[0]):
            self._end(TaskStatus.COMPLETED)
            return
        self._command(self._pursue())

    # --- pursuit -----------------------------------------------------------------------------

    def _pursue(self) -> Message:
        assert self._pose is not None
        found = self._parameters
        x, y, yaw = self._pose
        aim_x, aim_y = self._aim((x, y))
        aside = _wrapped(math.atan2(aim_y - y, aim_x - x) - yaw)
        turn = max(-found.fastest_turn, min(found.fastest_turn, 2.0 * aside))
        if abs(aside) > found.turn_on_the_spot:
            return messages.twist(0.0, turn)
        left = math.dist((x, y), self._routes[0][-1])
        speed = 0.0 if self._is_blocked() else min(found.cruise, 0.1 + 0.5 * left)
        return messages.twist(speed, turn)

    def _aim(self, here: Point) -> Point:
        """A point on the current leg, at some distance ahead."""
        start, end = self._routes[0][self._next - 1], self._routes[0][self._next]
        length = math.dist(start, end)
        along = _along(start, end, here) + self._parameters.lookahead
        share = min(1.0, along / length)
        return (
            start[0] + share * (end[0] - start[0]),
            start[1] + share * (end[1] - start[1]),
        )

    def _pass_points(self) -> None:
        assert self._pose is not None
        here = self._pose[:2]
        route = self._routes[0]
        while self._next < len(route):
            start, end = route[self._next - 1], route[self._next]
            is_near = math.dist(here, end) < self._parameters.arrival
            if not is_near and _along(start, end, here) < math.dist(start, end):
                return
            self._next += 1

    # --- what is heard -----------------------------------------------------------------------

    def _locate(self, message: Message) -> None:
        pose = message.pose.pose
        self._pose = (pose.position.x, pose.position.y, messages.yaw_of(pose.orientation))

    def _replan(self, message: Message) -> None:
        """The path is unusable: go back to the branch of the next route."""
        if not message.data or len(self._routes) < 2 or self._pose is None:
            return
        del self._routes[0]
        self.replanned += 1
        self._routes[0][0] = self._pose[:2]
        self._next = 1

    # --- progress ----------------------------------------------------------------------------

    def _look_for_progress(self, now_ns: int) -> None:
        assert self._pose is not None
        here = self._pose[:2]
        if math.dist(here, self._progress_at) > self._parameters.progress:
            self._progress_at, self._progress_ns = here, now_ns
        elif now_ns - self._progress_ns > self._parameters.patience * 1e9:
            self._end(TaskStatus.GIVEN_UP)

    def _end(self, outcome: TaskStatus) -> None:
        self.outcome = outcome
        done, self._done = self._done, None
        if done is not None:
            done(outcome is TaskStatus.COMPLETED)


def _along(start: Point, end: Point, here: Point) -> float:
    """The distance of a place along a leg."""
    length = math.dist(start, end)
    across = (here[0] - start[0]) * (end[0] - start[0]) + (here[1] - start[1]) * (end[1] - start[1])
    return across / length


def _wrapped(angle: float) -> float:
    return math.remainder(angle, 2 * math.pi)
