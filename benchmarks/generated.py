"""The monitor of ROSSMARie on the workload: the generated C called per sample, and from Python."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import cffi
import numpy as np
from in_process import Round, compile_shared, python_rows
from workload import PERIOD_NS, REALS, Columns, rossmarie_rules

from rossmarie.driver import compile_file
from rossmarie.driver.monitor import Monitor
from rossmarie.engines import start_monitor
from rossmarie.engines.python_monitor import PythonMonitor
from rossmarie.ir import Change, Event, Machine, Verdict
from rossmarie.native import NativeMonitor
from rossmarie.targets.c99 import generate
from rossmarie.targets.python import source

Engine = NativeMonitor | PythonMonitor

DECLARATIONS = """
void steps(size_t, int64_t *, double *, double *, double *, double *, uint8_t *, uint8_t *,
           uint64_t *);
void activity(size_t, int64_t *, double *, double *, double *, double *, uint8_t *, uint8_t *,
              uint64_t *);
"""

# The loop calls the generated update once per sample. The update is in a separate file, so the
# compiler cannot inline it. `steps` is timed; with three rules, it writes and counts the activity
# of the rules, as the hand-written loop does. `activity` counts any number of rules, untimed.
HARNESS = """
#include <stdlib.h>
#include <string.h>
#include "{name}_monitor.h"

static {name}_monitor m;

#define RUN(RECORD) \\
    if ({name}_init(&m, NULL, NULL)) \\
        abort(); \\
    memset(counts, 0, 3 * sizeof *counts); \\
    for (size_t i = 0; i < n; i++) {{ \\
        {name}_update_reading(&m, t[i], {arguments}); \\
        RECORD \\
    }}

#define COUNT_THREE \\
    unsigned active = m.active[0]; \\
    out[i] = (uint8_t)active; \\
    counts[0] += active & 1; \\
    counts[1] += active >> 1 & 1; \\
    counts[2] += active >> 2 & 1;

#define COUNT_ALL \\
    for (int rule = 0; rule < {name}_RULES; rule++) \\
        counts[rule % 3] += {name}_is_active(&m, rule);

#define COUNT_NOTHING

void steps(size_t n, const int64_t *t, const double *speed, const double *pitch,
           const double *distance, const double *force_z, const uint8_t *contact, uint8_t *out,
           uint64_t *counts)
{{
    (void)out;
    RUN({record})
}}

void activity(size_t n, const int64_t *t, const double *speed, const double *pitch,
              const double *distance, const double *force_z, const uint8_t *contact, uint8_t *out,
              uint64_t *counts)
{{
    (void)out;
    RUN(COUNT_ALL)
}}
"""


def machine(folder: Path, copies: int) -> Machine:
    """The workload, compiled by ROSSMARie."""
    folder.mkdir(parents=True, exist_ok=True)
    rules = folder / f"workload_{3 * copies}.ross"
    rules.write_text(rossmarie_rules(copies), encoding="utf-8")
    messages = [Path(__file__).parent / "msg"]
    return compile_file(rules, message_folders=messages).machine


class Generated:
    """The generated update, compiled with `flags` and called once per sample, without inlining."""

    def __init__(self, compiled: Machine, folder: Path, flags: list[str]) -> None:
        output = folder / f"{compiled.name}{''.join(flags)}.so"
        sources = [_write_harness(compiled, folder), folder / f"{compiled.name}_monitor.c"]
        compile_shared(sources, output, flags)
        self.ffi = cffi.FFI()
        self.ffi.cdef(DECLARATIONS)
        self.library: Any = self.ffi.dlopen(str(output))

    def over_columns(self, columns: Columns) -> Round:
        """One round over the columns. The counts come from `activity`, which is not timed."""
        from_buffer = self.ffi.from_buffer
        pointers = [from_buffer("int64_t[]", columns["t_ns"])]
        pointers += [from_buffer("double[]", columns[name]) for name in REALS]
        pointers.append(from_buffer("uint8_t[]", columns["contact"]))
        samples = len(columns["t_ns"])
        active = self.ffi.new("uint8_t[]", samples)
        counts = self.ffi.new("uint64_t[3]")
        self.library.activity(samples, *pointers, active, counts)
        found = list(counts)

        def run() -> tuple[float, list[int]]:
            start = time.process_time()
            self.library.steps(samples, *pointers, active, counts)
            return time.process_time() - start, found

        return run


def _write_harness(compiled: Machine, folder: Path) -> Path:
    for file, text in generate(compiled).items():
        path = folder / file
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    # The fields of the message, in the order of the parameters of the generated function.
    fields = [str(slot.path[0]) for slot in compiled.slots]
    harness = folder / f"{compiled.name}_steps.c"
    harness.write_text(
        HARNESS.format(
            name=compiled.name,
            arguments=", ".join(f"{field}[i]" for field in fields),
            record="COUNT_THREE" if len(compiled.rules) == 3 else "COUNT_NOTHING",
        ),
        encoding="utf-8",
    )
    return harness


def from_python_columns(compiled: Machine, columns: Columns, chunk: int) -> Round:
    """Run over bound numpy columns in chunks; the result is the activity after each sample."""
    times = columns["t_ns"]
    values = {name: columns[name] for name in (*REALS, "contact")}
    starts = range(0, len(times), chunk)

    def run() -> tuple[float, list[int]]:
        bound = Monitor(compiled).bind(times, values)
        start = time.process_time()
        results = [bound.run(first, first + chunk, active=True) for first in starts]
        took = time.process_time() - start
        active = np.concatenate([result.active for result in results])
        return took, [int(count) for count in active.sum(axis=0)]

    return run


def from_python_steps(compiled: Machine, columns: Columns) -> Round:
    """One call per sample with Python numbers. The counts come from the events."""
    return _steps(compiled, columns, lambda: start_monitor(compiled).engine)


def python_steps(compiled: Machine, columns: Columns) -> Round:
    """One call per sample of the generated Python, which needs no C compiler."""
    text = source(compiled)
    return _steps(compiled, columns, lambda: PythonMonitor(compiled, text))


def _steps(compiled: Machine, columns: Columns, start: Callable[[], Engine]) -> Round:
    names = ("t_ns", *REALS, "contact")
    order = [0, *(names.index(str(slot.path[0])) for slot in compiled.slots)]
    rows = [tuple(row[index] for index in order) for row in python_rows(columns)]
    end_ns = len(rows) * PERIOD_NS

    def run() -> tuple[float, list[int]]:
        monitor = start()
        step = monitor.update_call(0)
        begin = time.process_time()
        for row in rows:
            step(*row)
        took = time.process_time() - begin
        return took, _active_samples(compiled, monitor.take_events(), end_ns)

    return run


def _active_samples(compiled: Machine, events: Sequence[Event], end_ns: int) -> list[int]:
    """The number of samples at which each rule was active. Here, rules change only at samples."""
    counts = [0] * len(compiled.rules)
    for event in events:
        if isinstance(event, Verdict):
            left = (end_ns - event.at_ns) // PERIOD_NS
            counts[event.rule] += -left if event.change is Change.CLEARED else left
    return counts
