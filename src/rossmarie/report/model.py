"""The results of a replay: the one input of every report.

The driver fills a `Replay` after a monitor has run over a whole recording. Events have the order in
which the monitor yielded them. Instants are stamps in ns, which run backwards at a `TimeJump` (see
`axis.py`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rossmarie.ir import Event, Machine, TimeJump
from rossmarie.report.rehearsal import Rehearsed


@dataclass(frozen=True)
class PlotThreshold:
    """The place of a condition on the axis of a plot, in the unit of the plot.

    `limits` are the values at which its proposition changes. `regions` are the closed intervals
    (ends may be infinite) in which it supports a change of `rules`: their activation or, if
    `releases`, their clearing.
    """

    limits: tuple[float, ...]
    regions: tuple[tuple[float, float], ...]
    text: str
    rules: tuple[str, ...]
    releases: bool


@dataclass(frozen=True, eq=False)
class Plot:
    """One displayed signal.

    `times_s` (ascending, in s on the axis of the replay) and `values` (in `unit`, NaN if unknown)
    have the same length. A value holds until the next time.
    """

    text: str
    unit: str
    times_s: NDArray[np.float64]
    values: NDArray[np.float64]
    thresholds: tuple[PlotThreshold, ...]


@dataclass(frozen=True, eq=False)
class Replay:
    """A rules file run over a recording.

    `start_ns` and `end_ns` are the stamps of the first and last message. They are not the least and
    the greatest stamp, because stamps may run backwards. `monitor` is `native` or `python`. `notes`
    are the findings about the recording, one sentence each. `rehearsed` are the task commands that
    the rules would have given. `recorded` are the other numbers of the inputs, which a reader can
    add to the timeline.
    """

    machine: Machine
    rules_file: str
    recording: str
    monitor: str
    start_ns: int
    end_ns: int
    events: tuple[Event, ...]
    plots: tuple[Plot, ...]
    notes: tuple[str, ...]
    rehearsed: tuple[Rehearsed, ...] = ()
    recorded: tuple[Plot, ...] = ()

    @property
    def duration_ns(self) -> int:
        """The length of the replay: the sum of the parts between backward jumps."""
        repeated = sum(
            event.from_ns - event.to_ns for event in self.events if isinstance(event, TimeJump)
        )
        return self.end_ns - self.start_ns + repeated
