"""An action server in front of the real server. The guard is in between and can take it away from
the clients.

The kept goal belongs to the server, not to a task: when no task holds the server any more, the
command of the last task counts (R10).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from heron.goals import Goal, Server

Done = Callable[[bool], None]


@dataclass(frozen=True)
class _Order:
    """A goal of a client, with the client's callback."""

    goal: Goal
    done: Done


class Relay:
    """`server` returns the real server, which may appear later."""

    def __init__(self, server: Callable[[], Server]) -> None:
        self._server = server
        self._at_hand: _Order | None = None
        self._kept: _Order | None = None
        self._holders = 0

    # --- what clients see --------------------------------------------------------------------

    def send(self, goal: Goal, done: Done) -> None:
        """A goal of a client. While a task holds the server, the goal waits and replaces the
        previous goal.
        """
        order = _Order(goal, done)
        if self._holders:
            self._drop()
            self._kept = order
        else:
            self._forward(order)

    def cancel(self) -> None:
        """A client gives its goal up."""
        self._drop()
        if self._at_hand is not None:
            self._server().cancel()

    # --- what tasks do -----------------------------------------------------------------------

    def take(self) -> None:
        """A task has the server: the goal at hand is kept, and cancelled."""
        self._holders += 1
        if self._at_hand is not None:
            self._kept, self._at_hand = self._at_hand, None
            self._server().cancel()

    def send_own(self, goal: Goal, done: Done) -> None:
        """Send the goal of a task that holds the server."""
        self._server().send(goal, done)

    def cancel_own(self) -> None:
        """A task gives its own goal up."""
        self._server().cancel()

    def give_back(self, *, is_resent: bool) -> None:
        """A task has the server no more."""
        self._holders -= 1
        if self._holders:
            return
        kept, self._kept = self._kept, None
        if kept is not None and is_resent:
            self._forward(kept)
        elif kept is not None:
            kept.done(False)

    def _forward(self, order: _Order) -> None:
        self._at_hand = order

        def done(is_reached: bool) -> None:
            if self._at_hand is order:  # else a task has cancelled it, and it is kept
                self._at_hand = None
                order.done(is_reached)

        self._server().send(order.goal, done)

    def _drop(self) -> None:
        kept, self._kept = self._kept, None
        if kept is not None:
            kept.done(False)
