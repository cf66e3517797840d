"""The bounds of the safety filter (rules R11 and R12)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from rossmarie import ir
from rossmarie.ir import FieldBounds, Reactions
from rossmarie.ir.reactions import (
    Bound,
    Call,
    CancelGoal,
    Diagnose,
    Hook,
    Limit,
    Log,
    Publish,
    Reset,
    Retrace,
    Scale,
    SendGoal,
    SetParameter,
    SwitchControllers,
)

_UNBOUNDED = FieldBounds(1.0, -math.inf, math.inf)
_BLOCKED = FieldBounds(1.0, 0.0, 0.0)


@dataclass
class LimitState:
    """The state of a limit: in force, or the instant since which it is being lifted."""

    is_on: bool = False
    lifted_ns: int | None = None

    def moved(self, ramp: float | None, at_ns: int) -> float:
        """The distance by which a bound of the limit has moved outward."""
        if self.is_on:
            return 0.0
        if self.lifted_ns is None or ramp is None:
            return math.inf
        return ramp * (float(max(0, at_ns - self.lifted_ns)) / 1e9)


_NOTHING = LimitState()


class Filter:
    """The limits on the command topics: in force, or being lifted."""

    def __init__(self, reactions: Reactions) -> None:
        self._reactions = reactions
        self._forces = {
            index: LimitState()
            for index, task in enumerate(reactions.tasks)
            if isinstance(task.effect, Limit | Scale)
        }
        self._is_open = False

    @classmethod
    def of(cls, reactions: Reactions, task: int, force: LimitState) -> Filter:
        """An open filter in which only this limit counts."""
        found = cls(reactions)
        found._forces[task] = force
        found._is_open = True
        return found

    def open(self) -> None:
        """Open the filter: all inputs with a timeout have arrived once, or the grace period is over
        (R12).
        """
        self._is_open = True

    def lifted_ns(self, task: int) -> int:
        """The instant since which a limit is being lifted; `NEVER_NS` for all other tasks."""
        force = self._forces.get(task, _NOTHING)
        return ir.NEVER_NS if force.lifted_ns is None else force.lifted_ns

    def start(self, task: int) -> None:
        """Note the start of a task. Only limits and scales matter."""
        if task in self._forces:
            self._forces[task] = LimitState(is_on=True)

    def stop(self, task: int, at_ns: int) -> None:
        """Note the end of a task."""
        if task in self._forces:
            self._forces[task] = LimitState(is_on=False, lifted_ns=at_ns)

    def set_back(self, now_ns: int, at_ns: int) -> None:
        """R14: move all instants back from `now_ns` to an earlier instant."""
        for force in self._forces.values():
            if force.lifted_ns is not None:
                force.lifted_ns = at_ns - min(now_ns - force.lifted_ns, ir.LONGEST_NS)

    def bounds(self, at_ns: int, command: int) -> tuple[FieldBounds, ...]:
        """R11: the bounds of each field of a command topic, in the units of the message."""
        count = len(self._reactions.commands[command].fields)
        if not self._is_open or not ir.EARLIEST_NS < at_ns < ir.LATEST_NS:
            return (_BLOCKED,) * count
        found = [_UNBOUNDED] * count
        for task, force in self._forces.items():
            match self._reactions.tasks[task].effect:
                case Scale(topic=topic, factor=factor, ramp=ramp) if topic == command:
                    grown = factor + force.moved(ramp, at_ns)
                    found = [replace(bounds, factor=min(bounds.factor, grown)) for bounds in found]
                case Limit(topic=topic, bounds=limits) if topic == command:
                    for bound in limits:
                        moved = force.moved(bound.ramp, at_ns)
                        found[bound.field] = _within(found[bound.field], bound, moved)
                case (
                    Limit() | Scale() | Publish() | Retrace() | Call() | SetParameter()
                    | SwitchControllers() | SendGoal() | CancelGoal() | Log() | Diagnose()
                    | Hook() | Reset()
                ):  # fmt: skip
                    pass
        return tuple(found)


def _within(bounds: FieldBounds, bound: Bound, moved: float) -> FieldBounds:
    low, high = bound.low - moved, bound.high + moved
    return replace(bounds, low=max(bounds.low, low), high=min(bounds.high, high))
