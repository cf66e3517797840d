"""Imperfections of sensors: noise, slow errors, bandwidth and latency."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, field

import numpy as np

from heron.messages import Message
from heron.robot.physics import Floats
from heron.topics import Publish


class LowPass:
    """A filter with two poles at one frequency (Hz), for numbers at intervals of `step_ns`."""

    def __init__(self, frequency: float, step_ns: int) -> None:
        self._share = 1 - math.exp(-2 * math.pi * frequency * step_ns * 1e-9)
        self._first: Floats | None = None
        self._second: Floats | None = None

    def feed(self, values: Floats) -> Floats:
        """Filter the next numbers."""
        if self._first is None or self._second is None:
            self._first, self._second = values.copy(), values.copy()
        self._first += self._share * (values - self._first)
        self._second += self._share * (self._first - self._second)
        return self._second


class Drift:
    """An error that wanders: how large it is, and for how long (s) it stays alike."""

    def __init__(
        self, generator: np.random.Generator, spread: float, time_constant: float, size: int
    ) -> None:
        self._generator = generator
        self._spread = spread
        self._time_constant = time_constant
        self._error = generator.normal(0.0, spread, size)

    def after(self, step_s: float) -> Floats:
        """The error a while later."""
        kept = math.exp(-step_s / self._time_constant)
        fresh = self._generator.normal(0.0, self._spread, len(self._error))
        self._error = kept * self._error + math.sqrt(1 - kept * kept) * fresh
        return self._error


@dataclass
class Late:
    """Delayed messages: each message is published at its time."""

    publish: Publish
    latency_ns: int
    _waiting: deque[tuple[int, Message]] = field(default_factory=deque)

    def send(self, at_ns: int, message: Message) -> None:
        """A message sets out."""
        self._waiting.append((at_ns + self.latency_ns, message))

    def deliver(self, now_ns: int) -> None:
        """Publish all messages that are due."""
        while self._waiting and self._waiting[0][0] <= now_ns:
            self.publish(self._waiting.popleft()[1])
