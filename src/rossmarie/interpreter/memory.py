"""The memory of a monitor between two evaluations. Its size is bounded, because nothing grows with
the trace.
"""

from __future__ import annotations

import enum
import math
import operator
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce

from rossmarie import ir
from rossmarie.core import MOST_SAMPLES, SampleNumber, sampling_row
from rossmarie.interpreter.arithmetic import NAN
from rossmarie.ir import InputState, TruthValue, kleene


@dataclass
class InputMemory:
    """The state of an input and the instant of its last message (S9)."""

    state: InputState = InputState.NEVER
    stamp_ns: int = 0


class Samples:
    """The last two samples of a signal (S18), or the samples in a window, at most `MOST_SAMPLES`.
    For a function that feeds back (S50), they are its results.
    """

    def __init__(self, node: ir.Sampled) -> None:
        has_window = sampling_row(node.function).has_window
        self._window_ns = node.window_ns if has_window else 0
        self._time_ns = node.window_ns
        self._kept: deque[tuple[int, float]] = deque(maxlen=MOST_SAMPLES if has_window else 2)

    def forget(self) -> None:
        """Forget all samples."""
        self._kept.clear()

    def take(self, value: float, at_ns: int) -> None:
        """Take a sample. At an equal instant it replaces the last sample."""
        if self._kept and self._kept[-1][0] == at_ns:
            self._kept.pop()
        while self._window_ns and self._kept and at_ns - self._kept[0][0] >= self._window_ns:
            self._kept.popleft()
        self._kept.append((at_ns, value))

    def view(self, view: SampleNumber) -> float:
        """A number derived from the samples; NaN if samples are missing."""
        match view:
            case SampleNumber.NEWEST:
                return self._kept[-1][1] if self._kept else NAN
            case SampleNumber.BEFORE:
                return self._kept[-2][1] if len(self._kept) > 1 else NAN
            case SampleNumber.SECONDS:
                if len(self._kept) < 2:
                    return NAN
                return float(self._kept[-1][0] - self._kept[-2][0]) / 1e9
            case SampleNumber.LOWER:
                return self._ranked((len(self._kept) - 1) // 2)
            case SampleNumber.UPPER:
                return self._ranked(len(self._kept) // 2)
            case SampleNumber.TOTAL:
                return self._total()
            case SampleNumber.COUNT:
                return float(len(self._kept))
            case SampleNumber.CONSTANT:
                return float(self._time_ns) / 1e9

    def _total(self) -> float:
        """The sum of a window, the oldest sample first."""
        values = [value for _, value in self._kept]
        return reduce(operator.add, values) if values else NAN

    def _ranked(self, rank: int) -> float:
        """The sample of a window that has `rank` smaller samples before it. Among equal samples,
        the earlier comes first.
        """
        values = [value for _, value in self._kept]
        if not values or any(map(math.isnan, values)):
            return NAN
        return sorted(values)[rank]


@dataclass
class HeldMemory:
    """The instant since which the operand of a `for` has been true, and its value before (S33).
    Before the start, the operand counts as true only if the `for` states so.
    """

    start_ns: int | None = None
    before: TruthValue = TruthValue.FALSE


class Direction(enum.Enum):
    """The direction of an oscillating signal."""

    NONE = "none"
    UP = "up"
    DOWN = "down"


@dataclass
class Recent:
    """The instants of the last few turning points or edges, counted within a window (S32, S48).

    `gap` is the value of their source when the source was last unknown. `gap_end_ns` is the instant
    at which the gap ended; None while the gap lasts.
    """

    instants: deque[int]
    gap: TruthValue = TruthValue.FALSE
    gap_end_ns: int | None = 0

    def forget(self, at_ns: int) -> None:
        """Forget the past (S17)."""
        self.instants.clear()
        self.gap, self.gap_end_ns = TruthValue.UNKNOWN, at_ns

    def look(self, source: TruthValue, window_ns: int, at_ns: int) -> TruthValue:
        """Say whether enough instants lie in the window, given whether their source is known."""
        if source in (TruthValue.UNKNOWN, TruthValue.STALE):
            self.gap, self.gap_end_ns = source, None
        elif self.gap_end_ns is None:
            self.gap_end_ns = at_ns
        oldest_ns = self.oldest_ns()
        if oldest_ns is not None and at_ns - oldest_ns < window_ns:
            return TruthValue.TRUE
        is_near = self.gap_end_ns is None or at_ns - self.gap_end_ns < window_ns
        return self.gap if is_near else TruthValue.FALSE

    def oldest_ns(self) -> int | None:
        """The instant of the n-th latest turning point or edge; None if there are fewer."""
        return self.instants[0] if len(self.instants) == self.instants.maxlen else None


@dataclass
class Recurrence:
    """The edges of a condition (S48), and its value in the evaluation before."""

    recent: Recent
    before: TruthValue = TruthValue.FALSE

    def take(self, value: TruthValue, at_ns: int) -> None:
        """Take the value of the condition in an evaluation."""
        if value is TruthValue.TRUE and self.before is TruthValue.FALSE:
            self.recent.instants.append(at_ns)
        self.before = value


@dataclass
class Oscillation:
    """The turning points of a signal (S32)."""

    recent: Recent
    direction: Direction = Direction.NONE
    extreme: float = NAN

    def clear(self) -> None:
        """Forget the signal."""
        self.recent.instants.clear()
        self.direction = Direction.NONE
        self.extreme = NAN

    def take(self, x: float, swing: float, at_ns: int) -> None:
        """Take a finite sample."""
        if math.isnan(self.extreme) or self._goes_on(x):
            self.extreme = x
        elif self.direction is not Direction.UP and x > self.extreme + swing:
            self._turn(Direction.UP, x, at_ns)
        elif self.direction is not Direction.DOWN and x < self.extreme - swing:
            self._turn(Direction.DOWN, x, at_ns)

    def _goes_on(self, x: float) -> bool:
        if self.direction is Direction.UP:
            return x > self.extreme
        return self.direction is Direction.DOWN and x < self.extreme

    def _turn(self, direction: Direction, x: float, at_ns: int) -> None:
        if self.direction is not Direction.NONE:
            self.recent.instants.append(at_ns)
        self.direction = direction
        self.extreme = x


@dataclass
class MachineMemory:
    """The whole memory, by the indices of the machine. Elementwise signals and propositions have no
    entries of their own: their values stay NaN and None. `since` contains the value of each `since`
    at the last evaluation. An unknown array is None. `quantified` contains the results of
    quantifiers, computed when their elements arrived (S26).
    """

    slots: list[float]
    arrays: list[Sequence[float] | None]
    inputs: list[InputMemory]
    signals: list[float]
    samples: dict[int, Samples]
    truth_values: list[TruthValue | None]
    since_ns: list[int]
    oscillations: dict[int, Oscillation]
    recurrences: dict[int, Recurrence]
    held: dict[int, HeldMemory]
    since: dict[int, TruthValue]
    quantified: dict[int, TruthValue]
    now_ns: int | None = None

    def restart(self, at_ns: int) -> None:
        """Forget everything that was measured by the clock (S17)."""
        for samples in self.samples.values():
            samples.forget()
        for oscillation in self.oscillations.values():
            oscillation.clear()
            oscillation.recent.forget(at_ns)
        for recurrence in self.recurrences.values():
            recurrence.before = TruthValue.UNKNOWN
            recurrence.recent.forget(at_ns)
        for held in self.held:
            self.held[held] = HeldMemory(before=TruthValue.UNKNOWN)
        self.truth_values = [None] * len(self.truth_values)


def fresh_memory(machine: ir.Machine) -> MachineMemory:
    """The memory of a monitor in its initial state."""
    return MachineMemory(
        slots=[NAN] * len(machine.slots),
        arrays=[None] * len(machine.arrays),
        inputs=[InputMemory() for _ in machine.inputs],
        signals=[NAN] * len(machine.signals),
        samples={
            index: Samples(signal.node)
            for index, signal in enumerate(machine.signals)
            if isinstance(signal.node, ir.Sampled)
        },
        truth_values=[None] * len(machine.propositions),
        since_ns=[0] * len(machine.propositions),
        oscillations={
            index: Oscillation(Recent(deque(maxlen=proposition.node.count)))
            for index, proposition in enumerate(machine.propositions)
            if isinstance(proposition.node, ir.Oscillates)
        },
        recurrences={
            index: Recurrence(Recent(deque(maxlen=proposition.node.count)))
            for index, proposition in enumerate(machine.propositions)
            if isinstance(proposition.node, ir.Recurs)
        },
        held={
            index: HeldMemory(before=kleene.proposition_of(proposition.node.initially))
            for index, proposition in enumerate(machine.propositions)
            if isinstance(proposition.node, ir.Held)
        },
        since={
            index: TruthValue.FALSE
            for index, proposition in enumerate(machine.propositions)
            if isinstance(proposition.node, ir.Since)
        },
        quantified={
            index: TruthValue.UNKNOWN
            for index, proposition in enumerate(machine.propositions)
            if isinstance(proposition.node, ir.Quantified)
        },
    )
