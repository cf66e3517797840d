"""Steps of a guard in Python. Each number equals the number from the steps in C."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from operator import index as as_index
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from rossmarie import ir
from rossmarie.ir import (
    ChannelValues,
    CommandPart,
    FieldBounds,
    FieldPart,
    Machine,
    Publication,
    TaskState,
    Wiring,
)
from rossmarie.ir.clouds import leave_out
from rossmarie.native import CHANGED, CLOSED, REFUSED, REPORTED, fits, put_back


class Stepped(Protocol):
    """The interface of the guard that performs the steps."""

    @property
    def now_ns(self) -> int:
        """The current instant in ns; before the first call, an instant out of range."""

    @property
    def states(self) -> Sequence[TaskState]:
        """The state of each task, by index."""

    @property
    def has_all_inputs(self) -> bool:
        """True once every input with a timeout has arrived."""

    @property
    def has_news(self) -> bool:
        """True if there are events or task commands to take."""

    @property
    def begun(self) -> set[int]:
        """The tasks that have started, among the task commands that have not been taken."""

    def open(self) -> None:
        """Let commands pass."""

    def update(self, at_ns: int, messages: Mapping[int, ChannelValues]) -> None:
        """Process arriving messages."""

    def bounds(self, at_ns: int, command: int) -> Sequence[FieldBounds]:
        """The bounds on the fields of a command topic."""

    def note(self, said: int) -> bytes:
        """The facts after a step with these events."""


class PythonSteps:
    """Steps for arrays of the sizes in a wiring."""

    def __init__(self, machine: Machine, guard: Stepped, wiring: Wiring) -> None:
        self._guard = guard
        self._wiring = wiring
        self._slots, self._arrays = self._by_channel(machine)
        self._commands = [
            (command, list(parts))
            for command, parts in groupby(wiring.commands, key=lambda each: each.command)
        ]

    def _by_channel(
        self, machine: Machine
    ) -> tuple[dict[int, dict[int, FieldPart]], dict[int, dict[int, FieldPart]]]:
        """The parts of the slots and arrays of each arriving channel."""
        slots: dict[int, dict[int, FieldPart]] = {each: {} for each in self._wiring.arriving}
        arrays: dict[int, dict[int, FieldPart]] = {each: {} for each in self._wiring.arriving}
        for index, slot in enumerate(machine.slots):
            channel, part = machine.inputs[slot.input].channel, self._wiring.slots[index]
            if part.count and channel in slots:
                slots[channel][index] = part
        for index, array in enumerate(machine.arrays):
            channel, part = machine.inputs[array.input].channel, self._wiring.arrays[index]
            if channel in arrays:
                arrays[channel][index] = part
        return slots, arrays

    def step(
        self, at_ns: int, observation: NDArray[Any] | None, action: NDArray[Any] | None
    ) -> bytes | None:
        """Perform a step at an instant, with an observation, and an action that is changed in
        place. Returns the facts after the step. If the arguments do not fit, nothing changes, and
        the result is None.
        """
        if not (fits(observation, self._wiring.observed) and fits(action, self._wiring.acted)):
            return None
        at_ns = as_index(at_ns)
        if not ir.EARLIEST_NS < at_ns < ir.LATEST_NS or at_ns < self._guard.now_ns:
            return None
        if observation is not None:
            self._take(at_ns, observation.astype(np.float64).tolist())
        elif self._guard.now_ns == ir.EARLIEST_NS:
            return None
        said = 0 if action is None else self._decide(at_ns, action)
        said |= 0 if self._guard.has_all_inputs else CLOSED
        return self._guard.note(said | (REPORTED if self._guard.has_news else 0))

    def _decide(self, at_ns: int, action: NDArray[Any]) -> int:
        """Change an action into a permitted action. Returns bits that describe the changes."""
        begun = self._guard.begun
        numbers = action.astype(np.float64).tolist()
        said = 0
        for command, parts in self._commands:
            said |= self._bound(at_ns, command, parts, self._published(command, begun), numbers)
        if said & CHANGED:
            put_back(np.array(numbers), action)
        return said

    def allows(self, action: NDArray[np.float64]) -> bool:
        """Say whether an action would pass unchanged, at the instant of the last observation."""
        return self._decide(self._guard.now_ns, action.copy()) == 0

    def _take(self, at_ns: int, observation: Sequence[float]) -> None:
        """Process an observation."""
        self._guard.update(
            at_ns,
            {channel: self._message(channel, observation) for channel in self._wiring.arriving},
        )
        if self._guard.has_all_inputs:
            self._guard.open()

    def _message(self, channel: int, observation: Sequence[float]) -> ChannelValues:
        slots = {i: _of(part, observation)[0] for i, part in self._slots[channel].items()}
        arrays: dict[int, Sequence[float]] = {
            i: _of(part, observation) for i, part in self._arrays[channel].items()
        }
        for cloud in self._wiring.clouds:
            leave_out(cloud, arrays)
        return ChannelValues(slots, arrays)

    def _published(self, command: int, begun: set[int]) -> Iterator[float] | None:
        """The numbers that rules publish in place of this action; None if no rule publishes."""
        found = None
        for each in self._wiring.publications:
            if each.command == command and self._publishes(each, begun):
                found = iter(each.numbers)
        return found

    def _publishes(self, publication: Publication, begun: set[int]) -> bool:
        if publication.is_lasting:
            return self._guard.states[publication.task] is TaskState.HOLDING
        return publication.task in begun

    def _bound(
        self,
        at_ns: int,
        command: int,
        parts: Sequence[CommandPart],
        published: Iterator[float] | None,
        numbers: list[float],
    ) -> int:
        bounds = self._guard.bounds(at_ns, command)
        places = [(each, place) for each in parts for place in each.part.places]
        given = [_of_message(each.part, numbers[place]) for each, place in places]
        wanted = given if published is None else [next(published) for _ in places]
        is_refused = not all(map(math.isfinite, wanted))
        said = REFUSED if is_refused else 0
        for (each, place), before, number in zip(places, given, wanted, strict=True):
            bounded = 0.0 if is_refused else bounds[each.field].of(number)
            if bounded != before:
                numbers[place] = _of_action(each.part, bounded)
                said |= CHANGED
        return said


def _of(part: FieldPart, numbers: Sequence[float]) -> list[float]:
    return [_of_message(part, numbers[place]) for place in part.places]


def _of_message(part: FieldPart, number: float) -> float:
    if part.is_flag:
        return float(number != 0.0) if math.isfinite(number) else math.nan
    is_same = part.scale == 1.0 and part.offset == 0.0
    return number if is_same else number * part.scale + part.offset


def _of_action(part: FieldPart, value: float) -> float:
    is_same = part.scale == 1.0 and part.offset == 0.0
    return value if is_same else (value - part.offset) / part.scale
