"""The code that all Python peers share: the arguments, the trace, and the printed line of JSON."""

from __future__ import annotations

import json
import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from workload import PERIOD_NS, REALS, Constants, constants

PERIOD_S = PERIOD_NS / 1e9
Monitors = TypeVar("Monitors")


@dataclass(frozen=True)
class Arguments:
    """The arguments TRACE_FOLDER SAMPLES COPIES ROUNDS."""

    folder: Path
    samples: int
    copies: int
    rounds: int

    @classmethod
    def read(cls) -> Arguments:
        """Read the arguments from the command line."""
        folder, samples, copies, rounds = sys.argv[1:]
        return cls(Path(folder), int(samples), int(copies), int(rounds))

    @property
    def constants(self) -> list[Constants]:
        """The constants, one set for each copy of the rules."""
        return constants(self.copies)

    def rows(self) -> list[tuple[float, ...]]:
        """The samples as tuples: speed, pitch, distance, force_z, contact."""
        columns = [
            np.fromfile(self.folder / f"{name}.f64", "f8", self.samples).tolist() for name in REALS
        ]
        contact = np.fromfile(self.folder / "contact.u8", "u1", self.samples).tolist()
        return list(zip(*columns, contact, strict=True))


def measure(
    arguments: Arguments, build: Callable[[], Monitors], run: Callable[[Monitors], list[int]]
) -> None:
    """Print the median CPU time of `run` in nanoseconds per sample, and the counts."""
    seconds = []
    counts: list[int] = []
    for _ in range(arguments.rounds):
        monitors = build()
        start = time.process_time()
        counts = run(monitors)
        seconds.append(time.process_time() - start)
    nanoseconds = statistics.median(seconds) / arguments.samples * 1e9
    print(json.dumps({"nanoseconds": round(nanoseconds, 2), "counts": counts}))
