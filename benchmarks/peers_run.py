"""The peers. Each peer runs in a separate process that reports its CPU time and its counts."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from workload import c2po_rules, lola_rules

HERE = Path(__file__).parent
TIME_LIMIT_S = 600
_PLACE = re.compile(r"thread '.*panicked at ")
"""The line in which a Rust program reports the place of a panic; the reason follows."""


@dataclass(frozen=True)
class Workload:
    """The rules in `copies` copies, on the first samples of the trace in a folder.

    `bench` is the folder in which the peers are installed.
    """

    bench: Path
    trace: Path
    samples: int
    copies: int
    rounds: int


@dataclass(frozen=True)
class Measured:
    """The CPU time per sample (ns), and the number of active samples of each of the three rules."""

    nanoseconds: float
    counts: list[int]
    note: str = ""


@dataclass(frozen=True)
class LeftOut:
    """A peer without figures, and the reason."""

    name: str
    reason: str


class NotMeasuredError(Exception):
    """A peer is not installed, or did not finish."""


def reelay(workload: Workload) -> Measured:
    """Measure reelay: discrete time, one monitor per rule."""
    return _python_peer("reelay_peer.py", workload)


def rtamt(workload: Workload) -> Measured:
    """Measure rtamt: discrete time, the Python back end, one specification per rule."""
    return _python_peer("rtamt_peer.py", workload)


def rtlola(workload: Workload) -> Measured:
    """Measure the RTLola interpreter in a Rust program."""
    rules = lola_rules(workload.copies)
    specification = _lola_specification(workload.bench, f"{3 * workload.copies}", rules)
    program = workload.bench / "cargo" / "release" / "rtlola"
    return _measure([program, workload.trace, specification, workload.samples, workload.rounds])


def rtlola_in_rust(workload: Workload) -> Measured:
    """Measure the same specification, compiled to Rust and then to a program."""
    copies = workload.copies
    rules = tuple((rule, f"r{rule + 1}_{copy}") for copy in range(copies) for rule in range(3))
    program, seconds = _compiled_rtlola(workload.bench, f"{3 * copies}", lola_rules(copies), rules)
    measured = _measure([program, workload.trace, workload.samples, workload.rounds])
    return replace(measured, note=f"compiled in {seconds:,.0f} s")


def rtlola_operator(workload: Workload, name: str, specification: str) -> Measured:
    """Measure the specification of a single rule, the output `r1_0`, compiled to Rust."""
    program, _ = _compiled_rtlola(workload.bench, name, specification, ((0, "r1_0"),))
    return _measure([program, workload.trace, workload.samples, workload.rounds])


def r2u2(workload: Workload) -> Measured:
    """Measure the Rust core of R2U2 on a specification that C2PO compiled."""
    bench, rules = workload.bench, 3 * workload.copies
    specification = bench / f"rules_{rules}.c2po"
    specification.write_text(c2po_rules(workload.copies), encoding="utf-8")
    columns = bench / "columns.csv"
    columns.write_text("# speed,pitch,distance,force_z,contact\n0.1,0.1,0.1,0.1,1\n")
    output = bench / f"r2u2_{rules}"
    output.mkdir(exist_ok=True)
    compiler = bench / "tools" / "bin" / "r2u2_cli"
    _finished([compiler, "compile", specification, columns, "-o", output])
    program = bench / "cargo" / "release" / "r2u2"
    specification = output / "spec.bin"
    return _measure(
        [program, workload.trace, specification, workload.samples, rules, workload.rounds]
    )


@cache
def _compiled_rtlola(
    bench: Path, name: str, text: str, rules: tuple[tuple[int, str], ...]
) -> tuple[Path, float]:
    """The program, and the time of both compilers (s). `rules` has the outputs, each with the
    number of its rule.
    """
    folder = bench / f"rtlola_in_rust_{name}"
    folder.mkdir(exist_ok=True)
    specification = _lola_specification(bench, name, text)
    counts = (f"    counts[{rule}] += (v.{name} == Some(true)) as u64;" for rule, name in rules)
    counting = ["fn count(v: &Verdict, counts: &mut [u64; 3]) {", *counts, "}", ""]
    (folder / "count.rs").write_text("\n".join(counting), encoding="utf-8")
    shutil.copy(HERE / "peers" / "rust" / "compiled.rs", folder)
    release = bench / "cargo" / "release"
    start = time.monotonic()
    _finished(
        [
            *(bench / "tools" / "bin" / "rtlola2rust", "--optimize", "--overwrite"),
            *("--output-streams", ",".join(name for _, name in rules)),
            *("--output-dir", folder, specification),
        ]
    )
    program = folder / "compiled"
    _finished(
        [
            *("rustc", "--edition", "2021", "-C", "opt-level=3", "-A", "warnings"),
            *("--extern", f"peers={release / 'libpeers.rlib'}"),
            *("-L", f"dependency={release / 'deps'}", folder / "compiled.rs", "-o", program),
        ]
    )
    return program, time.monotonic() - start


def _lola_specification(bench: Path, name: str, text: str) -> Path:
    specification = bench / f"rules_{name}.lola"
    specification.write_text(text, encoding="utf-8")
    return specification


def _python_peer(script: str, workload: Workload) -> Measured:
    python = workload.bench / "venv" / "bin" / "python"
    return _measure(
        [
            *(python, HERE / "peers" / script),
            *(workload.trace, workload.samples, workload.copies, workload.rounds),
        ]
    )


def _measure(command: Sequence[object]) -> Measured:
    """The figures in the last line that a peer prints."""
    answer = json.loads(_finished(command).strip().splitlines()[-1])
    return Measured(answer["nanoseconds"], answer["counts"])


def _finished(command: Sequence[object]) -> str:
    """The standard output of a command. Raises `NotMeasuredError` with the reason of a failure."""
    words = [str(word) for word in command]
    name = Path(words[0]).name
    if shutil.which(words[0]) is None:
        raise NotMeasuredError(f"no {name}")
    try:
        done = subprocess.run(
            words, capture_output=True, text=True, timeout=TIME_LIMIT_S, check=False
        )
    except subprocess.TimeoutExpired:
        raise NotMeasuredError(f"{name} took more than {TIME_LIMIT_S} s") from None
    if done.returncode != 0:
        said = [each for each in done.stderr.splitlines() if each and not _PLACE.match(each)]
        reason = (said or ["no message"])[0]
        raise NotMeasuredError(f"{name} failed with exit code {done.returncode}: {reason}")
    return done.stdout
