"""Measure the monitor and its peers in one run, and write the page (`make bench`).

The figures are CPU times of the process. The contenders of a group run in turn on the typical and
on the worst trace; each figure is the median of the rounds, and each ratio compares medians of one
run. Every row also counts the active samples of the three rules and compares these counts with the
hand-written loop.
"""

from __future__ import annotations

import platform
import statistics
import subprocess
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import compiler_speed
import numpy as np
import peers_run
import start_up
from generated import (
    Generated,
    from_python_columns,
    from_python_steps,
    machine,
    python_steps,
)
from in_process import Hand, Round, closure_steps, numpy_whole_columns
from machine import processor
from peers_run import LeftOut, Measured, Workload
from workload import (
    PERIOD_NS,
    REST_PERIOD,
    REST_SAMPLES,
    SAMPLES,
    Columns,
    typical_trace,
    worst_trace,
    write_trace,
)
from written_page import written_page

HERE = Path(__file__).parent
BENCH = HERE.parent / "build" / "bench"
ROUNDS = 9
SCALED_SAMPLES = 100_000
PYTHON_SAMPLES = 200_000
VECTOR = ["-O3", "-march=native"]

Traces = Mapping[str, Columns]
Contender = Callable[[Columns], Round]


@dataclass(frozen=True)
class Outcome:
    """The CPU time on one trace, and the counts with the counts of the hand-written loop."""

    nanoseconds: float
    counts: list[int]
    expected: list[int]

    @property
    def agreement(self) -> str:
        """The comparison of the counts with the counts of the hand-written loop."""
        if self.counts == self.expected:
            return "equal"
        return ", ".join(
            f"{count - wanted:+d}" for count, wanted in zip(self.counts, self.expected, strict=True)
        )


@dataclass(frozen=True)
class Row:
    """One line of a table, with an outcome for each trace."""

    name: str
    outcomes: Mapping[str, Outcome]
    note: str = ""

    @property
    def agreement(self) -> str:
        """The agreement on all traces, or the agreement on each trace if they differ."""
        texts = {case: outcome.agreement for case, outcome in self.outcomes.items()}
        if len(set(texts.values())) == 1:
            return next(iter(texts.values()))
        return "; ".join(f"{case}: {text}" for case, text in texts.items())


def interleaved(contenders: Mapping[str, Contender], traces: Traces) -> dict[str, Row]:
    """Run each contender on each trace once per round, in turn.

    The first contender gives the expected counts.
    """
    rounds = {
        (name, case): contender(columns)
        for name, contender in contenders.items()
        for case, columns in traces.items()
    }
    seconds: dict[tuple[str, str], list[float]] = {each: [] for each in rounds}
    counts: dict[tuple[str, str], list[int]] = {}
    for _ in range(ROUNDS):
        for each, run in rounds.items():
            took, counts[each] = run()
            seconds[each].append(took)
    first = next(iter(contenders))

    def outcome(name: str, case: str, samples: int) -> Outcome:
        nanoseconds = statistics.median(seconds[name, case]) / samples * 1e9
        return Outcome(nanoseconds, counts[name, case], counts[first, case])

    return {
        name: Row(
            name,
            {case: outcome(name, case, len(columns["t_ns"])) for case, columns in traces.items()},
        )
        for name in contenders
    }


def head(traces: Traces, samples: int) -> Traces:
    """The first samples of every column."""
    return {
        case: {name: np.ascontiguousarray(column[:samples]) for name, column in columns.items()}
        for case, columns in traces.items()
    }


def three_rules(traces: Traces) -> Iterator[str]:
    """The tables of three rules."""
    compiled = machine(BENCH / "generated", 1)
    hand = Hand(HERE / "hand" / "hand.c", BENCH / "hand.so", ["-O2"])
    generated = Generated(compiled, BENCH / "generated", ["-O2"])
    in_c = interleaved(
        {
            "hand-written C, loop over columns": partial(hand.over_columns, "hand_loop"),
            "hand-written C, one opaque call per sample": partial(hand.over_columns, "hand_opaque"),
            "**generated C99, one opaque call per sample**": generated.over_columns,
            **{
                f"**ROSSMARie from Python, whole columns, chunks of {chunk:,}**": partial(
                    from_python_columns, compiled, chunk=chunk
                )
                for chunk in (SAMPLES, 10_000, 1_000, 100)
            },
            "numpy, whole arrays": numpy_whole_columns,
        },
        traces,
    )
    in_python = interleaved(
        {
            "hand-written Python closure, one call per sample": closure_steps,
            "**ROSSMARie from Python, one call per sample**": partial(from_python_steps, compiled),
            "**ROSSMARie without a C compiler, one call per sample**": partial(
                python_steps, compiled
            ),
        },
        head(traces, PYTHON_SAMPLES),
    )
    loop, opaque, ours = list(in_c.values())[:3]
    closure, step, python = in_python.values()
    yield "## Three rules, five conditions"
    yield ""
    peers = list(peer_rows(traces, 1))
    yield from table([*in_c.values(), *in_python.values(), *peers], 3)
    yield ""
    yield from RATIOS
    yield ratio("generated C99 step : hand-written opaque step", ours, opaque, "at most 1.15")
    for row in list(in_c.values())[3:6]:
        chunk = row.name.strip("*").partition("chunks of ")[2]
        name = f"whole columns from Python, chunks of {chunk} : hand-written C loop"
        yield ratio(name, row, loop, "at most 1.3")
    name = "one call per sample from Python : hand-written closure"
    yield ratio(name, step, closure, "at most 1.1")
    name = "one call per sample without a C compiler : hand-written closure"
    yield ratio(name, python, closure, "at most 1.1")
    yield from fastest_peer("generated C99 step", ours, peers)


RATIOS = ("| ratio | typical | worst | target (typical trace) |", "|---|---|---|---|")


def ratio(name: str, row: Row, base: Row, wanted: str) -> str:
    """One line of a table of ratios."""
    ratios = (
        f"{outcome.nanoseconds / base.outcomes[case].nanoseconds:.2f}"
        for case, outcome in row.outcomes.items()
    )
    return f"| {name} | {' | '.join(ratios)} | {wanted} |"


def fastest_peer(name: str, ours: Row, peers: Sequence[Row | LeftOut]) -> Iterator[str]:
    """The ratio to the first and fastest peer, if the peer was measured."""
    match peers[0]:
        case Row() as peer:
            yield ratio(f"{name} : RTLola compiled to Rust", ours, peer, "below 1")
        case LeftOut():
            pass


@dataclass(frozen=True)
class Peer:
    """A peer. `samples` holds for three rules; more rules run on fewer samples."""

    name: str
    measure: Callable[[Workload], Measured]
    samples: int
    note: str = ""


PEERS = (
    Peer("RTLola compiled to Rust, rtlola2rust 0.1.0", peers_run.rtlola_in_rust, SAMPLES),
    Peer("RTLola, rtlola-interpreter 0.11.0", peers_run.rtlola, 100_000),
    Peer(
        "R2U2, r2u2_core 4.2.4",
        peers_run.r2u2,
        100_000,
        "weak start; comparisons with a tolerance of 1e-5",
    ),
    Peer("reelay 25.0.0", peers_run.reelay, 20_000, "weak start"),
    Peer("rtamt 0.4.10", peers_run.rtamt, 5_000, "weak start; computes robustness (more work)"),
)


def peer_rows(traces: Traces, copies: int) -> Iterator[Row | LeftOut]:
    """The peers, each on as many samples as it can process in reasonable time."""
    hand = Hand(HERE / "hand" / "hand.c", BENCH / "hand.so", ["-O2"])
    for peer in PEERS:
        samples = max(peer.samples // copies, 500)
        outcomes = {}
        notes = [peer.note]
        try:
            for case, columns in head(traces, samples).items():
                workload = Workload(
                    BENCH, BENCH / "trace" / case, samples, copies, 3 if copies == 1 else 1
                )
                measured = peer.measure(workload)
                expected = hand.table(columns, copies)()[1]
                outcomes[case] = Outcome(measured.nanoseconds, measured.counts, expected)
                notes.append(measured.note)
        except peers_run.NotMeasuredError as reason:
            print(f"bench: {peer.name} is not measured: {reason}")
            yield LeftOut(peer.name, str(reason))
        else:
            yield Row(peer.name, outcomes, "; ".join(dict.fromkeys(filter(None, notes))))


def scaling(traces: Traces) -> Iterator[str]:
    """The tables of 30 and 300 rules."""
    folder = BENCH / "generated"
    for copies in (10, 100):
        compiled = machine(folder, copies)
        hand = Hand(HERE / "hand" / "hand.c", BENCH / "hand.so", ["-O2"])
        fast = Hand(HERE / "hand" / "hand.c", BENCH / "hand_vector.so", VECTOR)
        rows = interleaved(
            {
                "hand-written C table, -O2": partial(hand.table, copies=copies),
                "hand-written C table, -O3 -march=native": partial(fast.table, copies=copies),
                "**generated C99, -O2**": Generated(compiled, folder, ["-O2"]).over_columns,
                "**generated C99, -O3 -march=native**": Generated(
                    compiled, folder, VECTOR
                ).over_columns,
            },
            head(traces, SCALED_SAMPLES),
        )
        hand_written, _, ours, _ = rows.values()
        yield f"## {3 * copies} rules"
        yield ""
        peers = list(peer_rows(traces, copies))
        yield from table([*rows.values(), *peers], 3 * copies)
        yield ""
        yield from RATIOS
        yield ratio("generated C99 : hand-written C table, both -O2", ours, hand_written, "below 1")
        yield from fastest_peer("generated C99, -O2", ours, peers)
        yield ""


def table(rows: Iterable[Row | LeftOut], rules: int) -> Iterator[str]:
    """Rows as Markdown."""
    typical, worst = (f"{case}: ns per sample | ns per rule" for case in ("typical", "worst"))
    yield f"| | {typical} | {worst} | counts | notes |"
    yield "|---|---|---|---|---|---|---|"
    for row in rows:
        match row:
            case LeftOut(name, reason):
                yield f"| {name} | | | | | not measured | {reason} |"
            case Row(name, outcomes, note):
                times = " | ".join(
                    f"{outcome.nanoseconds:,.1f} | {outcome.nanoseconds / rules:,.2f}"
                    for outcome in outcomes.values()
                )
                yield f"| {name} | {times} | {row.agreement} | {note} |"


PREFACE = """# Performance of the monitor

Written by `make bench`; do not edit. All figures are CPU times from one run on one machine
({machine}).
The contenders run in turn; each figure is the median of {rounds} rounds. The peers run separately:
3 rounds with three rules, 1 round with more rules. Absolute figures hold for this machine only;
ratios carry over to other machines. A call is *opaque* if the compiler cannot inline it.

**Rules.** The five conditions are speed > 0.5 for 2.0 s; |pitch| > 10 for 4.0 s; distance < 0.8;
force_z > 15 for 0.3 s; and not contact. Rule 1 joins the first and the third condition. Rule 2
joins the second condition and speed > 0.05. Rule 3 joins the fourth and the fifth condition. The
sets of 30 and 300 rules are copies of these three rules with other constants.

**Traces.** Both traces have {samples:,} samples of speed, pitch, distance, force_z and contact, at
100 Hz. In the *typical* trace, the numbers are seeded random walks that resemble slow sensors: most
samples change no comparison. In the *worst* trace, each sample changes every comparison of every
rule: all numbers jump from one side of all their limits to the other. Only the last
{rest:.0f} s of each {rest_period:,.0f} s stay on one side, so that all rules become active. The
sets of 30 and 300 rules run on the first {scaled:,} samples.

A monitor that evaluates everything for each sample needs about the same time for both traces. The
hand-written loops and RTLola are such monitors. The monitor of ROSSMARie evaluates only the parts
that depend on a changed comparison. In the typical trace, few parts do. In the worst trace, all
parts do, and the search for these parts makes the monitor slower than a plain evaluation.

**Counts.** For each of the three rules (and its copies), a row counts the samples at which the rule
was active, and compares this count with the hand-written loop on the same samples. Most peers run
on fewer samples. A peer that sees less than {rest_period:,.0f} s of the worst trace sees only
the jumps, and during the jumps no rule becomes active. For such a peer, "equal" means little. A
peer with a *weak start* assumes that each condition was true before the first sample. ROSSMARie
does not assume this. A peer with a weak start therefore reports a rule earlier.

**RTLola compiled to Rust** uses the same specification as the RTLola interpreter. Its output is
limited to the streams of the rules, and the compiler option is `opt-level=3`, as for the other
programs in Rust. Its conditions count samples, but the conditions of ROSSMARie measure time. Both
agree only at a steady 100 Hz.
"""


def describe_machine() -> str:
    """The processor, the compiler and Python."""
    done = subprocess.run(["cc", "--version"], capture_output=True, text=True, check=True)
    compiler = done.stdout.splitlines()[0]
    return f"{processor()}; {compiler}; Python {platform.python_version()}"


def main() -> None:
    """Measure, print and write the page."""
    out = written_page("Measure the monitor and its peers.")
    traces = {"typical": typical_trace(), "worst": worst_trace()}
    for case, columns in traces.items():
        write_trace(BENCH / "trace" / case, columns)
    preface = PREFACE.format(
        rounds=ROUNDS,
        machine=describe_machine(),
        samples=SAMPLES,
        scaled=SCALED_SAMPLES,
        rest=REST_SAMPLES * PERIOD_NS / 1e9,
        rest_period=REST_PERIOD * PERIOD_NS / 1e9,
    )
    lines = [
        preface,
        *three_rules(traces),
        "",
        *scaling(traces),
        *compiler_speed.lines(BENCH / "generated"),
        "",
        *start_up.lines(),
    ]
    text = "\n".join(lines) + "\n"
    out.write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
