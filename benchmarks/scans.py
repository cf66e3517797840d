"""Measure rules about laser scans, including the part of the node that unpacks a scan; write the
table as a page.
"""

from __future__ import annotations

import subprocess
import tempfile
import time
from collections.abc import Iterator
from datetime import datetime, timezone
from pathlib import Path

import cffi
from in_process import Round
from machine import processor
from operators import ROUNDS, machine, nanoseconds
from written_page import written_page

import rossmarie
from rossmarie import ir
from rossmarie.targets.c99 import generate, types

BEAMS = (360, 720, 1440)
SCANS = 2_000
CONDITIONS = {
    "ahead": "min(scan.ranges[-30 deg .. 30 deg]) < 0.5 m",
    "around": "min(scan.ranges[-180 deg .. 180 deg]) < 0.5 m",
    "points": "count(p in scan.points: p.x in [0.1, 1] m and abs(p.y) < 0.3 m) >= 3",
    "invalid": "count(b in scan.invalid: b.angle in [-30, 30] deg) > 20",
}
_RULES = """
action react;
input scan = topic /scan : sensor_msgs/LaserScan up to {beams} timeout 1 sec;
rule r: if {condition} then {{ react; }};
"""
_HARNESS = """
#include "scans.h"

#include <array>
#include <cstdlib>

extern "C" {{
#include "{name}_monitor.h"
void drive(unsigned scans, unsigned long long *active);
}}

struct Scan {{
    float angle_min = -3.14159274F, angle_max, angle_increment, range_min = 0.1F, range_max = 12.0F;
    std::vector<float> ranges, intensities;
}};

static std::array<double, {beams}> room[3];
static std::vector<double> found;

void drive(unsigned scans, unsigned long long *active)
{{
    static {name}_monitor m;
    Scan scan;
    scan.angle_increment = 6.28318531F / {beams};
    scan.angle_max = scan.angle_min + scan.angle_increment * ({beams} - 1);
    unsigned state = 1;
    for (std::size_t i = 0; i != {beams}; i++) {{
        state = state * 1664525U + 1013904223U;
        const float share = static_cast<float>(state >> 8) / 16777216.0F;
        scan.ranges.push_back(share < 0.05F ? 0.0F : 13.0F * share); // no return
    }}
    scan.intensities.resize({beams});
    if ({name}_init(&m, nullptr, nullptr))
        std::abort();
    *active = 0;
    for (unsigned i = 0; i != scans; i++) {{
        scan.ranges[i % {beams}] += 0.001F;
{take}
        {name}_update_scan(&m, static_cast<std::int64_t>(i) * 25000000, {arguments});
        *active += {name}_is_active(&m, 0);
    }}
}}
"""


def in_c(folder: Path, code: str, condition: str, beams: int) -> Round:
    """The generated update with the header of the node, scan by scan."""
    name = f"{code}_{beams}"
    compiled = machine(folder, name, _RULES.format(condition=condition, beams=beams))
    take, arguments = _taken(compiled, beams)
    harness = _HARNESS.format(name=compiled.name, beams=beams, take=take, arguments=arguments)
    library, ffi = _built(folder, compiled, harness)
    active = ffi.new("unsigned long long *")

    def run() -> tuple[float, list[int]]:
        start = time.process_time()
        library.drive(SCANS, active)
        return time.process_time() - start, [active[0]]

    return run


def _taken(compiled: ir.Machine, beams: int) -> tuple[str, str]:
    """The statement that unpacks a scan, and the arguments of the update."""
    first, *_ = compiled.arrays
    last = first.path[-1]
    if isinstance(last, ir.Sector):
        angles = f"{types.number(last.first)}, {types.number(last.width)}"
        return f"        sector(scan, {angles}, found);", "found.data(), found.size()"
    fields = types.fields_of(compiled, 0)
    columns = ", ".join(
        f"{{BeamField::{str(compiled.arrays[field.array or 0].path[-1]).upper()}, "
        f"room[{place}].data()}}"
        for place, field in enumerate(fields)
    )
    are_points = "true" if ir.RETURNS in first.path else "false"
    take = f"        const std::size_t count = beams(scan, {are_points}, {beams}, {{{columns}}});"
    given = [f"room[{place}].data()" for place in range(len(fields))]
    return take, ", ".join([*given, "count"])


def _built(folder: Path, compiled: ir.Machine, harness: str) -> tuple[cffi.FFI, cffi.FFI]:
    for file, text in generate(compiled).items():
        path = folder / file
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    steps, output = folder / f"{compiled.name}_steps.cpp", folder / f"{compiled.name}.so"
    part = folder / f"{compiled.name}_monitor.o"
    steps.write_text(harness, encoding="utf-8")
    headers = Path(rossmarie.__file__).parent / "runtime" / "ros"
    flags = ["-O2", "-ffp-contract=off", "-fPIC"]
    monitor = folder / f"{compiled.name}_monitor.c"
    for command in (
        ["cc", "-std=c99", *flags, "-c", monitor, "-o", part],
        ["g++", "-std=c++17", *flags, "-shared", f"-I{headers}", steps, part, "-o", output],
    ):
        subprocess.run(command, check=True, cwd=folder)
    ffi = cffi.FFI()
    ffi.cdef("void drive(unsigned, unsigned long long *);")
    return ffi.dlopen(str(output)), ffi


def rows(folder: Path) -> Iterator[str]:
    """A row for each condition."""
    contenders = {
        (code, beams): (in_c(folder, code, condition, beams), SCANS)
        for code, condition in CONDITIONS.items()
        for beams in BEAMS
    }
    found = nanoseconds({f"{code} {beams}": each for (code, beams), each in contenders.items()})
    for code, condition in CONDITIONS.items():
        cells = " | ".join(f"{found[f'{code} {beams}'] / 1000:.1f}" for beams in BEAMS)
        yield f"| `{condition}` | {cells} |"


PREFACE = """\
# Cost of conditions about laser scans

Written by `benchmarks/scans.py`; do not edit. Each condition is the only condition of a rule. The
times include the code of the generated nodes that unpacks a scan, and the generated monitor. The
input is {scans:,} scans of random distances; about one distance in twenty is 0. All figures are
CPU times from one run on one machine ({processor}, {day}),
the medians of {rounds} rounds. Absolute figures hold for this machine only.
"""


def page() -> str:
    """The text of the page."""
    with tempfile.TemporaryDirectory() as folder:
        found = list(rows(Path(folder)))
    day = datetime.now(timezone.utc).date()
    preface = PREFACE.format(scans=SCANS, processor=processor(), day=day, rounds=ROUNDS)
    heads = " | ".join(f"µs, {beams} beams" for beams in BEAMS)
    rule = f"|---|{'---|' * len(BEAMS)}"
    return "\n".join([preface, f"| condition | {heads} |", rule, *found, ""])


def main() -> None:
    """Measure and write the page."""
    written_page(__doc__).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
