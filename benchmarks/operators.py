"""Measure each operator over time or over a list in a separate rule, and the cost of scopes and
exemptions; write the table as a page.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

import cffi
import numpy as np
from generated import Generated, from_python_steps, python_steps
from in_process import Round, compile_shared
from machine import processor
from peers_run import NotMeasuredError, Workload, rtlola_operator
from skill_rules import OF_SKILLS, of_skills, skill_harness, write_skills
from workload import REALS, Columns, typical_trace, worst_trace, write_trace
from written_page import written_page

from rossmarie.driver import compile_file
from rossmarie.ir import Machine
from rossmarie.targets.c99 import generate

BENCH = Path(__file__).parents[1] / "build" / "bench"
SAMPLES = 50_000
OF_PYTHON = 5_000
ROUNDS = 5
ELEMENTS = 16


@dataclass(frozen=True)
class Operator:
    """An operator in a condition of ROSSMARie, and in lines of RTLola; the last line is the rule.
    `code` is a name for files.
    """

    code: str
    condition: str
    lola: tuple[str, ...]


OPERATORS = (
    Operator("comparison", "speed > 0.5", ("speed > 0.5",)),
    Operator(
        "for",
        "speed > 0.5 for 2 sec",
        (
            "output n: UInt64 := if speed > 0.5 then n.offset(by: -1).defaults(to: 0) + 1 else 0",
            "n > 200",
        ),
    ),
    Operator(
        "since",
        "speed > 0.5 since contact",
        ("contact || (speed > 0.5 && r1_0.offset(by: -1).defaults(to: false))",),
    ),
    Operator(
        "once",
        "once speed > 0.9 within 2 sec",
        (
            "output n: UInt64 := if speed > 0.9 then 0 "
            "else n.offset(by: -1).defaults(to: 1000000) + 1",
            "n <= 200",
        ),
    ),
    Operator(
        "after",
        "not (after contact, speed < 0.5 within 1 sec)",
        (
            "output p: UInt64 := if speed < 0.5 then 0 "
            "else if contact || p.offset(by: -1).defaults(to: 0) > 0 "
            "then p.offset(by: -1).defaults(to: 0) + 1 else 0",
            "p > 100",
        ),
    ),
    Operator(
        "edges",
        "count(edges of speed > 0.5 within 2 sec) > 3",
        (
            "output up := speed > 0.5",
            "output e: UInt64 := if up && !up.offset(by: -1).defaults(to: false) then 1 else 0",
            "e.aggregate(over_discrete: 200, using: sum) > 3",
        ),
    ),
    Operator(
        "changed",
        "changed(contact)",
        ("contact != contact.offset(by: -1).defaults(to: contact)",),
    ),
    Operator(
        "mean",
        "mean(speed, 0.5 sec) > 0.5",
        ("speed.aggregate(over_discrete: 50, using: avg).defaults(to: 0.0) > 0.5",),
    ),
    Operator(
        "median",
        "median(speed, 0.5 sec) > 0.5",
        ("speed.aggregate(over_discrete: 50, using: median).defaults(to: 0.0) > 0.5",),
    ),
    Operator(
        "low_pass",
        "low_pass(speed, 0.2 sec) > 0.5",
        (
            "output y: Float64 := y.offset(by: -1).defaults(to: speed) + "
            "0.01 / 0.21 * (speed - y.offset(by: -1).defaults(to: speed))",
            "y > 0.5",
        ),
    ),
)

OF_A_LIST = "any(p in path: p.pose.position.x > 0.5 m)"


def specification(operator: Operator) -> str:
    """The specification of the rule in RTLola."""
    *streams, rule = operator.lola
    inputs = [f"input {name}: Float64" for name in REALS] + ["input contact: Bool"]
    return "\n".join([*inputs, *streams, f"output r1_0: Bool := {rule}", ""])


def machine(folder: Path, code: str, text: str) -> Machine:
    """Compile a rules file with one rule."""
    rules = folder / f"of_{code}.ross"
    rules.write_text(text, encoding="utf-8")
    return compile_file(rules, message_folders=[Path(__file__).parent / "msg"]).machine


def of_samples(operator: Operator) -> str:
    """The rules file with a rule about the numbers of the workload."""
    used = [name for name in (*REALS, "contact") if name in operator.condition]
    inputs = [f"input {name} = topic /reading : bench_msgs/Sample .{name};" for name in used]
    rule = f"rule r: if {operator.condition} then {{ react; }};"
    return "\n".join(["action react;", *inputs, rule, ""])


# --- a list ----------------------------------------------------------------------------------

LIST_RULES = f"""
action react;
input path = topic /plan : nav_msgs/Path .poses up to {ELEMENTS};
rule r: if {OF_A_LIST} then {{ react; }};
"""
LIST_HARNESS = f"""
#include <stdlib.h>
#include "of_list_monitor.h"

void lists(size_t n, const int64_t *t, const double *x)
{{
    static of_list_monitor m;
    if (of_list_init(&m, NULL, NULL))
        abort();
    for (size_t i = 0; i < n; i++)
        of_list_update_plan(&m, t[i], x + {ELEMENTS} * i, {ELEMENTS});
}}
"""


def over_lists(folder: Path, columns: Columns) -> Round:
    """The generated update with a full list, whose elements are the last samples."""
    compiled = machine(folder, "list", LIST_RULES)
    library, ffi = built(folder, compiled, LIST_HARNESS, "void lists(size_t, int64_t *, double *);")
    speed = columns["speed"]
    elements = np.stack([np.roll(speed, shift) for shift in range(ELEMENTS)], axis=1).copy()
    times, numbers = (ffi.from_buffer(kind, values) for kind, values in (
        ("int64_t[]", columns["t_ns"]), ("double[]", elements.reshape(-1))
    ))  # fmt: skip

    def run() -> tuple[float, list[int]]:
        start = time.process_time()
        library.lists(len(speed), times, numbers)
        return time.process_time() - start, []

    return run


# --- skills ----------------------------------------------------------------------------------


def over_skills(folder: Path, code: str, columns: Columns) -> Round:
    """The generated updates: a skill context ten times a second, and a speed with each sample. The
    skill runs while `contact` is true.
    """
    write_skills(folder)
    compiled = machine(folder, code, of_skills(OF_SKILLS[code]))
    harness = skill_harness(compiled)
    library, ffi = built(folder, compiled, harness, "void skilled(size_t, int64_t *, double *, "
                         "uint8_t *, uint64_t *);")  # fmt: skip
    pointers = [
        ffi.from_buffer(kind, columns[name])
        for kind, name in (("int64_t[]", "t_ns"), ("double[]", "speed"), ("uint8_t[]", "contact"))
    ]
    active = ffi.new("uint64_t *")

    def run() -> tuple[float, list[int]]:
        start = time.process_time()
        library.skilled(len(columns["t_ns"]), *pointers, active)
        return time.process_time() - start, [active[0]]

    return run


def built(folder: Path, compiled: Machine, harness: str, declaration: str) -> tuple[Any, Any]:
    """A monitor with a loop around it, built as a library, and the FFI that calls the loop."""
    for file, text in generate(compiled).items():
        path = folder / file
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    steps, output = folder / f"{compiled.name}_steps.c", folder / f"{compiled.name}.so"
    steps.write_text(harness, encoding="utf-8")
    compile_shared([steps, folder / f"{compiled.name}_monitor.c"], output, ["-O2"])
    ffi = cffi.FFI()
    ffi.cdef(declaration)
    return ffi.dlopen(str(output)), ffi


def skill_rows(
    folder: Path, typical: Columns, worst: Columns, reference_ns: float
) -> Iterator[str]:
    """The rows of a rule without a scope, with a scope, and with an exemption, measured in turn."""
    rounds = {
        (code, name): (over_skills(folder, code, columns), len(columns["t_ns"]))
        for code in OF_SKILLS
        for name, columns in (("typical", typical), ("worst", worst))
    }
    found = nanoseconds({f"{code} {name}": each for (code, name), each in rounds.items()})
    for code, rule in OF_SKILLS.items():
        took = found[f"{code} typical"]
        yield (
            f"| `{rule}` | {took:.1f} | {took / reference_ns:.1f} | {found[f'{code} worst']:.1f} "
            "| | | no skills |"
        )


# --- the page --------------------------------------------------------------------------------


def first(columns: Columns, samples: int) -> Columns:
    """The first samples of a trace."""
    return {name: column[:samples].copy() for name, column in columns.items()}


def nanoseconds(rounds: Mapping[str, tuple[Round, int]]) -> dict[str, float]:
    """The median time per sample (ns) of each contender; the contenders run in turn."""
    took: dict[str, list[float]] = {name: [] for name in rounds}
    for _ in range(ROUNDS):
        for name, (run, samples) in rounds.items():
            took[name].append(run()[0] / samples * 1e9)
    return {name: statistics.median(found) for name, found in took.items()}


def of_rtlola(operator: Operator, trace: Path, counted: int) -> str:
    """The cell of RTLola compiled to Rust: its time and a difference of counts, or the reason why
    RTLola is not measured.
    """
    workload = Workload(BENCH, trace, SAMPLES, 1, 3)
    try:
        measured = rtlola_operator(workload, f"of_{operator.code}", specification(operator))
    except NotMeasuredError as error:
        return f"not measured: {error}"
    off = measured.counts[0] - counted
    return f"{measured.nanoseconds:.1f}" + (f" ({off:+} samples)" if off else "")


def rows(folder: Path) -> Iterator[str]:
    """A row for each operator."""
    typical, worst = (first(trace, SAMPLES) for trace in (typical_trace(), worst_trace()))
    write_trace(folder / "trace", typical)
    reference_ns: float | None = None
    for operator in OPERATORS:
        compiled = machine(folder, operator.code, of_samples(operator))
        built = Generated(compiled, folder, ["-O2"])
        short = first(typical, OF_PYTHON)
        calm = built.over_columns(typical)
        found = nanoseconds(
            {
                "typical": (calm, SAMPLES),
                "worst": (built.over_columns(worst), SAMPLES),
                "python": (from_python_steps(compiled, short), OF_PYTHON),
                "without": (python_steps(compiled, short), OF_PYTHON),
            }
        )
        reference_ns = reference_ns or found["typical"]
        peer = of_rtlola(operator, folder / "trace", calm()[1][0])
        yield (
            f"| `{operator.condition}` | {found['typical']:.1f} "
            f"| {found['typical'] / reference_ns:.1f} | {found['worst']:.1f} "
            f"| {found['python']:.0f} | {found['without']:.0f} | {peer} |"
        )
    lists = {
        name: (over_lists(folder, columns), SAMPLES)
        for name, columns in (("typical", typical), ("worst", worst))
    }
    found = nanoseconds(lists)
    assert reference_ns is not None, "the operators are measured first"
    yield (
        f"| `{OF_A_LIST}` with {ELEMENTS} elements | {found['typical']:.1f} "
        f"| {found['typical'] / reference_ns:.1f} | {found['worst']:.1f} | | | no lists |"
    )
    yield from skill_rows(folder, typical, worst, reference_ns)


PREFACE = """\
# Cost of operators

Written by `benchmarks/operators.py`; do not edit. Each condition is the only condition of a
rule, and its inputs have no timeout. All figures are CPU times from one run on one machine
({processor}, {day}). The contenders run in turn; each figure is the median of {rounds}
rounds over {samples:,} samples at 100 Hz ({of_python:,} samples from Python). Absolute figures
hold for this machine only; ratios carry over to other machines.

The traces are the traces of [the benchmark of the monitor](performance.md): in the worst trace,
each sample changes every comparison. A list has all its elements in each message. The last
three rows have the same rule without a scope, with a scope, and with an exemption. The times of
these rows include a call after each sample that reads the state of the rule. With a scope and with
an exemption, the times also include ten messages per second that report the running skill.

RTLola is compiled to Rust. Its specification counts samples, or has a window of a number of
samples; at a steady rate, it means the same as the condition. If RTLola counts a different number
of active samples, the cell shows the difference. rtlola2rust 0.1.0 does not implement windows of a
number of samples.
"""
COLUMNS = (
    "condition",
    "C99, typical trace: ns per sample",
    "ratio to a comparison",
    "C99, worst trace: ns per sample",
    "from Python, one call per sample, ns",
    "without a C compiler, ns",
    "RTLola in Rust, ns",
)


def page() -> str:
    """The text of the page."""
    BENCH.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        found = list(rows(Path(folder)))
    preface = PREFACE.format(
        processor=processor(),
        day=datetime.now(timezone.utc).date(),
        rounds=ROUNDS,
        samples=SAMPLES,
        of_python=OF_PYTHON,
    )
    head = [f"| {' | '.join(COLUMNS)} |", f"|{'---|' * len(COLUMNS)}"]
    return "\n".join([preface, *head, *found, ""])


def main() -> None:
    """Measure and write the page."""
    written_page(__doc__).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
