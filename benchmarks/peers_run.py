"""The peers, each in a process of its own that reports CPU time and counts."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from workload import c2po_rules, lola_rules

HERE = Path(__file__).parent
TIME_LIMIT_S = 600


@dataclass(frozen=True)
class Measured:
    """Nanoseconds of CPU a sample, and the active samples of each of the three rules."""

    nanoseconds: float
    counts: list[int]


def reelay(bench: Path, samples: int, copies: int, rounds: int) -> Measured | None:
    """Discrete time, one monitor a rule."""
    return _python_peer(bench, "reelay_peer.py", samples, copies, rounds)


def rtamt(bench: Path, samples: int, copies: int, rounds: int) -> Measured | None:
    """Discrete time, the Python back end, one specification a rule."""
    return _python_peer(bench, "rtamt_peer.py", samples, copies, rounds)


def rtlola(bench: Path, samples: int, copies: int, rounds: int) -> Measured | None:
    """The interpreter, in process."""
    specification = bench / f"rules_{3 * copies}.lola"
    specification.write_text(lola_rules(copies), encoding="utf-8")
    program = bench / "cargo" / "release" / "rtlola"
    return _measure([program, bench / "trace", specification, samples, rounds])


def r2u2(bench: Path, samples: int, copies: int, rounds: int) -> Measured | None:
    """The Rust core, in process, on what C2PO compiled."""
    specification = bench / f"rules_{3 * copies}.c2po"
    specification.write_text(c2po_rules(copies), encoding="utf-8")
    columns = bench / "columns.csv"
    columns.write_text("# speed,pitch,distance,force_z,contact\n0.1,0.1,0.1,0.1,1\n")
    output = bench / f"r2u2_{3 * copies}"
    output.mkdir(exist_ok=True)
    compiler = bench / "tools" / "bin" / "r2u2_cli"
    if not compiler.is_file():
        return None
    subprocess.run(
        [compiler, "compile", specification, columns, "-o", output],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        check=False,
    )
    program = bench / "cargo" / "release" / "r2u2"
    return _measure([program, bench / "trace", output / "spec.bin", samples, 3 * copies, rounds])


def _python_peer(
    bench: Path, script: str, samples: int, copies: int, rounds: int
) -> Measured | None:
    python = bench / "venv" / "bin" / "python"
    return _measure([python, HERE / "peers" / script, bench / "trace", samples, copies, rounds])


def _measure(command: Sequence[object]) -> Measured | None:
    """What the last line of a peer says; None if it is not there or did not finish."""
    words = [str(word) for word in command]
    if not Path(words[0]).exists():
        return None
    try:
        done = subprocess.run(
            words, capture_output=True, text=True, timeout=TIME_LIMIT_S, check=False
        )
    except subprocess.TimeoutExpired:
        return None
    if done.returncode != 0 or not done.stdout.strip():
        return None
    answer = json.loads(done.stdout.strip().splitlines()[-1])
    return Measured(answer["nanoseconds"], answer["counts"])
