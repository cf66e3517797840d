"""`make bench`: measure everything in one run and write the table.

CPU time of the process, contenders of a group run in turn, medians over the rounds; ratios are
those of medians of one run. Every row also counts the active samples of the three rules, and says
whether they are those of the hand-written loop.
"""

from __future__ import annotations

import platform
import statistics
import subprocess
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import compiler_speed
import numpy as np
import peers_run
import start_up
from generated import (
    from_python_columns,
    from_python_steps,
    machine,
    opaque_steps,
    python_steps,
)
from in_process import Columns, Hand, Round, closure_steps, numpy_whole_columns
from machine import processor
from workload import SAMPLES, trace, write_trace
from written_page import written_page

HERE = Path(__file__).parent
BENCH = HERE.parent / "build" / "bench"
ROUNDS = 9
SCALED_SAMPLES = 100_000
PYTHON_SAMPLES = 200_000
VECTOR = ["-O3", "-march=native"]


@dataclass(frozen=True)
class Row:
    """One line of a table."""

    name: str
    nanoseconds: float
    counts: list[int]
    expected: list[int]
    note: str = ""

    @property
    def agreement(self) -> str:
        """How the counts compare with those of the hand-written loop."""
        if self.counts == self.expected:
            return "equal"
        return ", ".join(
            f"{count - wanted:+d}" for count, wanted in zip(self.counts, self.expected, strict=True)
        )


def interleaved(rounds: Mapping[str, Round], samples: int, times: int) -> dict[str, Row]:
    """Run each contender once a round, in turn; the first one is the yardstick of the counts."""
    seconds: dict[str, list[float]] = {name: [] for name in rounds}
    counts: dict[str, list[int]] = {}
    for _ in range(times):
        for name, run in rounds.items():
            took, counts[name] = run()
            seconds[name].append(took)
    expected = counts[next(iter(rounds))]
    return {
        name: Row(name, statistics.median(seconds[name]) / samples * 1e9, counts[name], expected)
        for name in rounds
    }


def head(columns: Columns, samples: int) -> Columns:
    """The first samples of every column."""
    return {name: np.ascontiguousarray(column[:samples]) for name, column in columns.items()}


def three_rules(columns: Columns) -> Iterator[str]:
    """The table of three rules."""
    compiled = machine(BENCH / "generated", 1)
    hand = Hand(HERE / "hand" / "hand.c", BENCH / "hand.so", ["-O2"])
    in_c = interleaved(
        {
            "hand-written C, loop over columns": hand.over_columns("hand_loop", columns),
            "hand-written C, one opaque call a sample": hand.over_columns("hand_opaque", columns),
            "**our C99, one opaque call a sample**": opaque_steps(
                compiled, BENCH / "generated", ["-O2"], columns
            ),
            **{
                f"**ours from Python, whole columns, chunks of {chunk:,}**": from_python_columns(
                    compiled, columns, chunk
                )
                for chunk in (SAMPLES, 10_000, 1_000, 100)
            },
            "numpy, whole arrays": numpy_whole_columns(columns),
        },
        SAMPLES,
        ROUNDS,
    )
    few = head(columns, PYTHON_SAMPLES)
    in_python = interleaved(
        {
            "hand-written Python closure, one call a sample": closure_steps(few, PYTHON_SAMPLES),
            "**ours from Python, one call a sample**": from_python_steps(
                compiled, few, PYTHON_SAMPLES
            ),
            "**ours without a C compiler, one call a sample**": python_steps(
                compiled, few, PYTHON_SAMPLES
            ),
        },
        PYTHON_SAMPLES,
        ROUNDS,
    )
    rows = [*in_c.values(), *in_python.values(), *peer_rows(columns, 1)]
    loop, opaque, ours = list(in_c.values())[:3]
    closure, step, python = in_python.values()
    yield "## Three rules, five conditions"
    yield ""
    yield from table(rows)
    yield ""
    yield "| ratio | measured | to reach |"
    yield "|---|---|---|"
    yield ratio("C99 step : hand-written opaque step", ours, opaque, "1.15")
    for row in list(in_c.values())[3:6]:
        chunk = row.name.strip("*").partition("chunks of ")[2]
        yield ratio(f"whole columns from Python, chunks of {chunk} : C loop", row, loop, "1.3")
    yield ratio("one call a sample from Python : hand-written closure", step, closure, "1.1")
    yield ratio("the same without a C compiler : hand-written closure", python, closure, "1.1")


def ratio(name: str, row: Row, base: Row, wanted: str) -> str:
    """One line of a table of ratios."""
    return f"| {name} | {row.nanoseconds / base.nanoseconds:.2f} | at most {wanted} |"


PEERS: Mapping[str, Callable[[Path, int, int, int], peers_run.Measured | None]] = {
    "RTLola, rtlola-interpreter 0.11.0": peers_run.rtlola,
    "R2U2, r2u2_core 4.2.4": peers_run.r2u2,
    "reelay 25.0.0": peers_run.reelay,
    "rtamt 0.4.10": peers_run.rtamt,
}
PEER_SAMPLES = {
    "RTLola, rtlola-interpreter 0.11.0": 100_000,
    "R2U2, r2u2_core 4.2.4": 100_000,
    "reelay 25.0.0": 20_000,
    "rtamt 0.4.10": 5_000,
}
PEER_NOTES = {
    "R2U2, r2u2_core 4.2.4": "weak start, and comparisons within 1e-5",
    "reelay 25.0.0": "weak start",
    "rtamt 0.4.10": "weak start; computes robustness, which is more",
}


def peer_rows(columns: Columns, copies: int) -> Iterator[Row]:
    """The peers that are installed, on as many samples as they can do in reasonable time."""
    hand = Hand(HERE / "hand" / "hand.c", BENCH / "hand.so", ["-O2"])
    for name, measure in PEERS.items():
        samples = max(PEER_SAMPLES[name] // copies, 500)
        measured = measure(BENCH, samples, copies, 3 if copies == 1 else 1)
        if measured is None:
            print(f"bench: {name} is not installed or did not finish")
            continue
        expected = hand.table(head(columns, samples), copies)()[1]
        note = PEER_NOTES.get(name, "")
        yield Row(name, measured.nanoseconds, measured.counts, expected, note)


def scaling(columns: Columns) -> Iterator[str]:
    """The tables of 30 and 300 rules."""
    few = head(columns, SCALED_SAMPLES)
    for copies in (10, 100):
        compiled = machine(BENCH / "generated", copies)
        folder = BENCH / "generated"
        hand = Hand(HERE / "hand" / "hand.c", BENCH / "hand.so", ["-O2"])
        fast = Hand(HERE / "hand" / "hand.c", BENCH / "hand_vector.so", VECTOR)
        rows = interleaved(
            {
                "hand-written C table, -O2": hand.table(few, copies),
                "hand-written C table, -O3 -march=native": fast.table(few, copies),
                "**our C99, -O2**": opaque_steps(compiled, folder, ["-O2"], few),
                "**our C99, -O3 -march=native**": opaque_steps(compiled, folder, VECTOR, few),
            },
            SCALED_SAMPLES,
            ROUNDS,
        )
        yield f"## {3 * copies} rules"
        yield ""
        yield from table([*rows.values(), *peer_rows(columns, copies)], rules=3 * copies)
        yield ""


def table(rows: list[Row], rules: int = 3) -> Iterator[str]:
    """Rows as Markdown."""
    yield "| | ns a sample | ns a rule | counts against the C loop | |"
    yield "|---|---|---|---|---|"
    for row in rows:
        times = f"{row.nanoseconds:,.1f} | {row.nanoseconds / rules:,.2f}"
        yield f"| {row.name} | {times} | {row.agreement} | {row.note} |"


PREFACE = """# Performance

Written by `make bench`; do not edit. CPU time of the process, everything in one run on one machine,
contenders in turn, medians of {rounds} rounds. Absolute figures are those of this machine
({machine}); ratios carry over.

**The workload.** {samples:,} samples at 100 Hz of speed, pitch, distance, force_z and contact,
seeded random walks. Conditions: speed > 0.5 for 2.0 s; |pitch| > 10 for 4.0 s; distance < 0.8;
force_z > 15 for 0.3 s; not contact. Rules: the first and the third; the second and speed > 0.05;
the fourth and the fifth. 30 and 300 rules are copies with other constants, on the first
{scaled:,} samples. The peers run on fewer samples, and their counts are compared on those.
"""


def describe_machine() -> str:
    """The processor, the compiler and Python."""
    done = subprocess.run(["cc", "--version"], capture_output=True, text=True, check=True)
    compiler = done.stdout.splitlines()[0]
    return f"{processor()}; {compiler}; Python {platform.python_version()}"


def main() -> None:
    """Measure, print and write."""
    out = written_page("Measure the monitor beside its peers.")
    columns = trace()
    write_trace(BENCH / "trace", columns)
    preface = PREFACE.format(
        rounds=ROUNDS, machine=describe_machine(), samples=SAMPLES, scaled=SCALED_SAMPLES
    )
    lines = [
        preface,
        *three_rules(columns),
        "",
        *scaling(columns),
        *compiler_speed.lines(BENCH / "generated"),
        "",
        *start_up.lines(),
    ]
    text = "\n".join(lines) + "\n"
    out.write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
