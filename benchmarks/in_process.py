"""The references that run in this process: hand-written C, numpy and plain Python.

Each round returns its CPU time (s) and, for each of the three rules, the number of samples at which
the rule was active.
"""

from __future__ import annotations

import subprocess
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cffi
import numpy as np
from numpy.typing import NDArray
from workload import REALS, Columns, constants

Round = Callable[[], tuple[float, list[int]]]

DECLARATIONS = """
typedef struct {
    double speed, pitch, distance, force_z, creep;
    int64_t fast_samples, tilted_samples, pushed_samples;
} hand_constants;
void hand_loop(size_t, int64_t *, double *, double *, double *, double *, uint8_t *, uint8_t *,
               uint64_t *);
void hand_opaque(size_t, int64_t *, double *, double *, double *, double *, uint8_t *, uint8_t *,
                 uint64_t *);
void hand_table(size_t, int64_t *, double *, double *, double *, double *, uint8_t *, size_t,
                hand_constants *, uint64_t *);
"""


def compile_shared(sources: list[Path], output: Path, flags: list[str]) -> None:
    """Compile a shared library with the C compiler of the system.

    Calls inside the library go directly to their target, as in a program that links the monitor.
    """
    command = ["cc", "-std=gnu99", "-shared", "-fPIC", "-Wl,-Bsymbolic-functions"]
    command += ["-ffp-contract=off", *flags]
    subprocess.run([*command, *map(str, sources), "-o", str(output), "-lm"], check=True)


class Hand:
    """The library of hand.c, compiled with `flags`."""

    def __init__(self, source: Path, output: Path, flags: list[str]) -> None:
        compile_shared([source], output, flags)
        self.ffi = cffi.FFI()
        self.ffi.cdef(DECLARATIONS)
        self.library: Any = self.ffi.dlopen(str(output))

    def pointers(self, columns: Columns) -> list[Any]:
        """The pointers to the columns."""
        real = [self.ffi.from_buffer("double[]", columns[name]) for name in REALS]
        times = self.ffi.from_buffer("int64_t[]", columns["t_ns"])
        return [times, *real, self.ffi.from_buffer("uint8_t[]", columns["contact"])]

    def over_columns(self, function: str, columns: Columns) -> Round:
        """One round of the C function `hand_loop` or `hand_opaque`."""
        call = getattr(self.library, function)
        pointers = self.pointers(columns)
        samples = len(columns["t_ns"])
        active = self.ffi.new("uint8_t[]", samples)
        counts = self.ffi.new("uint64_t[3]")

        def run() -> tuple[float, list[int]]:
            start = time.process_time()
            call(samples, *pointers, active, counts)
            return time.process_time() - start, list(counts)

        return run

    def table(self, columns: Columns, copies: int) -> Round:
        """One round of the C function `hand_table` with `copies` copies of the rules."""
        pointers = self.pointers(columns)
        samples = len(columns["t_ns"])
        rows = [tuple(vars(one).values()) for one in constants(copies)]
        sets = self.ffi.new("hand_constants[]", rows)
        counts = self.ffi.new("uint64_t[3]")

        def run() -> tuple[float, list[int]]:
            start = time.process_time()
            self.library.hand_table(samples, *pointers, copies, sets, counts)
            return time.process_time() - start, list(counts)

        return run


def numpy_whole_columns(columns: Columns) -> Round:
    """One round of numpy over the whole trace at once."""
    c = constants(1)[0]

    def held(condition: NDArray[np.bool_], samples: int) -> NDArray[np.bool_]:
        index = np.arange(len(condition))
        last_false = np.maximum.accumulate(np.where(condition, -1, index))
        result: NDArray[np.bool_] = index - last_false > samples
        return result

    def run() -> tuple[float, list[int]]:
        start = time.process_time()
        fast = held(columns["speed"] > c.speed, c.fast_samples)
        tilted = held(np.abs(columns["pitch"]) > c.pitch, c.tilted_samples)
        pushed = held(columns["force_z"] > c.force_z, c.pushed_samples)
        rules = (
            fast & (columns["distance"] < c.distance),
            tilted & (columns["speed"] > c.creep),
            pushed & (columns["contact"] == 0),
        )
        counts = [int(np.count_nonzero(rule)) for rule in rules]
        return time.process_time() - start, counts

    return run


Step = Callable[[int, float, float, float, float, int], tuple[bool, bool, bool]]


def hand_closure() -> Step:
    """A hand-written function in plain Python that makes one step per call."""
    never = 1 << 62
    since_fast = since_tilted = since_pushed = never

    def step(
        t: int, speed: float, pitch: float, distance: float, force_z: float, contact: int
    ) -> tuple[bool, bool, bool]:
        nonlocal since_fast, since_tilted, since_pushed
        if speed > 0.5:
            if since_fast > t:
                since_fast = t
        else:
            since_fast = never
        if pitch > 10 or pitch < -10:
            if since_tilted > t:
                since_tilted = t
        else:
            since_tilted = never
        if force_z > 15:
            if since_pushed > t:
                since_pushed = t
        else:
            since_pushed = never
        return (
            t - since_fast >= 2_000_000_000 and distance < 0.8,
            t - since_tilted >= 4_000_000_000 and speed > 0.05,
            t - since_pushed >= 300_000_000 and not contact,
        )

    return step


def python_rows(columns: Columns) -> list[tuple[Any, ...]]:
    """The samples as Python numbers: t (ns), speed, pitch, distance, force_z, contact."""
    names = ("t_ns", *REALS, "contact")
    return list(zip(*(columns[name].tolist() for name in names), strict=True))


def closure_steps(columns: Columns) -> Round:
    """One round of the hand-written closure, one call per sample."""
    rows = python_rows(columns)

    def run() -> tuple[float, list[int]]:
        step = hand_closure()
        first = second = third = 0
        start = time.process_time()
        for row in rows:
            one, two, three = step(*row)
            first += one
            second += two
            third += three
        return time.process_time() - start, [first, second, third]

    return run
