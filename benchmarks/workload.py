"""The workload of the benchmark: two traces, and the same three rules in many copies.

A trace has a million samples of speed, pitch, distance, force_z and contact, at 100 Hz. In the
typical trace, the numbers are seeded random walks that return to their mean, and contact is a
seeded switch. In the worst trace, every sample changes every comparison. The workload has five
conditions and three rules; for 30 and 300 rules, the rules are repeated with other constants.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

SAMPLES = 1_000_000
PERIOD_NS = 10_000_000
SEED = 20240607
REST_SAMPLES = 500
REST_PERIOD = 100_000
REALS = ("speed", "pitch", "distance", "force_z")
Columns = dict[str, NDArray[Any]]


@dataclass(frozen=True)
class Constants:
    """The constants of one copy of the three rules. Durations are in samples."""

    speed: float
    pitch: float
    distance: float
    force_z: float
    creep: float
    fast_samples: int
    tilted_samples: int
    pushed_samples: int


def constants(copies: int) -> list[Constants]:
    """The constants of `copies` copies. The first copy is the plain workload."""
    return [
        Constants(
            speed=0.5 + 0.002 * copy,
            pitch=10 + 0.01 * copy,
            distance=0.8 - 0.001 * copy,
            force_z=15 + 0.01 * copy,
            creep=0.05 + 0.001 * copy,
            fast_samples=200 + copy % 7,
            tilted_samples=400 + copy % 11,
            pushed_samples=30 + copy % 5,
        )
        for copy in range(copies)
    ]


def typical_trace() -> Columns:
    """The columns: `t_ns` as int64, four columns as float64, and `contact` as uint8."""
    random = np.random.default_rng(SEED)
    columns: Columns = {
        "t_ns": np.arange(SAMPLES, dtype=np.int64) * PERIOD_NS,
        "speed": np.abs(_walk(random, 0.55, 0.30, 20.0, 0.5)),
        "pitch": _walk(random, 0.0, 9.0, 15.0, 16.0),
        "distance": np.abs(_walk(random, 1.0, 0.4, 3.0, -0.5)),
        "force_z": _walk(random, 12.0, 4.0, 1.0, 6.0),
    }
    switches = random.random(SAMPLES) < 1 / 300.0
    columns["contact"] = (np.cumsum(switches) % 2).astype(np.uint8)
    return columns


def worst_trace() -> Columns:
    """The same columns. With each sample, all numbers jump to the other side of all their limits.

    The last samples of each `REST_PERIOD` stay on the side on which all conditions hold, until
    every rule is active. Otherwise no count would distinguish two monitors.
    """
    index = np.arange(SAMPLES)
    is_resting = index % REST_PERIOD >= REST_PERIOD - REST_SAMPLES
    holds = is_resting | (index % 2 == 1)
    return {
        "t_ns": index.astype(np.int64) * PERIOD_NS,
        "speed": np.where(holds, 1.0, 0.0),
        "pitch": np.where(holds, 20.0, 0.0),
        "distance": np.where(holds, 0.5, 1.5),
        "force_z": np.where(holds, 20.0, 10.0),
        "contact": np.where(holds, 0, 1).astype(np.uint8),
    }


def _walk(
    random: np.random.Generator, mean: float, deviation: float, memory_s: float, start: float
) -> NDArray[np.float64]:
    """The samples of an Ornstein-Uhlenbeck process, rounded to six decimals."""
    keep = np.exp(-PERIOD_NS / 1e9 / memory_s)
    kicks = (random.standard_normal(SAMPLES) * deviation * np.sqrt(1 - keep * keep)).tolist()
    value = start
    values = np.empty(SAMPLES)
    for index, kick in enumerate(kicks):
        value = keep * value + kick
        values[index] = value
    return np.round(values + mean, 6)


def write_trace(folder: Path, columns: Columns) -> None:
    """Write the columns as raw little-endian files, for peers in other languages."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in REALS:
        columns[name].tofile(folder / f"{name}.f64")
    columns["contact"].tofile(folder / "contact.u8")


def rossmarie_rules(copies: int) -> str:
    """The workload in the rule language."""
    return "\n".join(_rossmarie_lines(copies)) + "\n"


def _rossmarie_lines(copies: int) -> Iterator[str]:
    for name in (*REALS, "contact"):
        yield f"input {name} = topic /reading : bench_msgs/Sample .{name};"
    yield "action react;"
    for copy, c in enumerate(constants(copies)):
        yield f"entity e{copy} {{"
        yield f"    fast : speed > {c.speed!r} for {c.fast_samples * 10} ms;"
        yield f"    tilted : abs(pitch) > {c.pitch!r} for {c.tilted_samples * 10} ms;"
        yield f"    near : distance < {c.distance!r};"
        yield f"    pushed : force_z > {c.force_z!r} for {c.pushed_samples * 10} ms;"
        yield "    apart : not contact;"
        yield "}"
        yield f"rule near_{copy}: if e{copy}.fast and e{copy}.near then {{ react; }};"
        yield f"rule tilt_{copy}: if e{copy}.tilted and speed > {c.creep!r} then {{ react; }};"
        yield f"rule push_{copy}: if e{copy}.pushed and e{copy}.apart then {{ react; }};"


def lola_rules(copies: int) -> str:
    """The workload in RTLola, with event counters and a strong start."""
    lines = [f"input {name}: Float64" for name in REALS] + ["input contact: Bool"]
    for copy, c in enumerate(constants(copies)):
        conditions = (
            ("a", f"speed > {c.speed!r}", c.fast_samples),
            ("b", f"(pitch > {c.pitch!r} || pitch < {-c.pitch!r})", c.tilted_samples),
            ("c", f"force_z > {c.force_z!r}", c.pushed_samples),
        )
        for name, condition, samples in conditions:
            stream = f"{name}_{copy}"
            past = f"{stream}.offset(by: -1).defaults(to: 0)"
            lines.append(f"output {stream}: UInt64 := if {condition} then {past} + 1 else 0")
            lines.append(f"output h{stream} := {stream} > {samples}")
        lines.append(f"output r1_{copy} := ha_{copy} && distance < {c.distance!r}")
        lines.append(f"output r2_{copy} := hb_{copy} && speed > {c.creep!r}")
        lines.append(f"output r3_{copy} := hc_{copy} && !contact")
    return "\n".join(lines) + "\n"


def c2po_rules(copies: int) -> str:
    """The workload in R2U2's language: past-time MLTL with a weak start."""
    lines = ["INPUT", "  speed, pitch, distance, force_z: float;", "  contact: bool;", "", "PTSPEC"]
    for c in constants(copies):
        tilted = f"(pitch > {c.pitch!r}) || (pitch < {-c.pitch!r})"
        lines += [
            f"  H[0,{c.fast_samples}] (speed > {c.speed!r}) && (distance < {c.distance!r});",
            f"  H[0,{c.tilted_samples}] ({tilted}) && (speed > {c.creep!r});",
            f"  H[0,{c.pushed_samples}] (force_z > {c.force_z!r}) && !contact;",
        ]
    return "\n".join(lines) + "\n"
