"""The compiler or `init` reports compiler flags and processor modes that change the results of the
generated C.
"""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from rossmarie.targets import c99
from support.c_compiler import each_c_compiler, write
from support.compiled import machine_of
from support.parts import CLANG, GCC, X86, needs
from support.small_rules import BOUNDED

MAIN = """\
#include <stdio.h>
#include "bounded_monitor.h"
#include "bounded_reactor.h"
#if defined(MODE)
#include <xmmintrin.h>
#endif

static bounded_monitor m;
static bounded_reactor r;

int main(void)
{
#if defined(MODE)
    _mm_setcsr(_mm_getcsr() | MODE);
#endif
    const char *const of_monitor = bounded_init(&m, NULL, NULL);
    const char *const of_reactor = bounded_reactor_init(&r, NULL, NULL);
    printf("%s\\n%s\\n", of_monitor ? of_monitor : "right", of_reactor ? of_reactor : "right");
    return 0;
}
"""
RIGHT = "right"
REFUSED = "compile without -ffast-math"
REGROUPED = "sums are regrouped"
DIVIDED = "divisions are multiplications"
UNSIGNED = "zeros have no sign"
CONTRACTED = "contracted"
FLUSHED = "subnormal numbers count as 0"
ROUNDED = "not rounded to nearest"

SAFE = (
    "-O0",
    "-O2",
    "-O3 -march=native",
    "-Os",
    "-O2 -flto",
    "-O2 -frounding-math",
    "-O2 -fno-math-errno",
    "-O2 -fno-trapping-math",
    "-std=gnu17 -O2",
)
MODES = {
    "0x8000": FLUSHED,
    "0x0040": FLUSHED,
    "0x2000": ROUNDED,
    "0x4000": ROUNDED,
    "0x6000": ROUNDED,
}
"""Bits of the control register of SSE: flush to zero, denormals are zero, and ways of rounding."""

UNSAFE = (
    ("gcc", "-O2 -ffast-math", REFUSED),
    ("gcc", "-Ofast", REFUSED),
    ("gcc", "-O0 -ffinite-math-only", REFUSED),
    ("gcc", "-O2 -ffinite-math-only", REFUSED),
    ("gcc", "-O2 -funsafe-math-optimizations", REFUSED),
    ("gcc", "-O2 -fassociative-math -fno-signed-zeros -fno-trapping-math", REFUSED),
    ("gcc", "-O2 -freciprocal-math", REFUSED),
    ("gcc", "-O2 -fno-signed-zeros", REFUSED),
    ("gcc", "-O2 -fsingle-precision-constant", "constants are float"),
    ("clang", "-O2 -ffast-math", REFUSED),
    ("clang", "-Ofast", REFUSED),
    ("clang", "-O2 -ffinite-math-only", REFUSED),
    ("clang", "-O2 -funsafe-math-optimizations", REGROUPED),
    ("clang", "-O2 -fassociative-math -fno-signed-zeros -fno-trapping-math", REGROUPED),
    ("clang", "-O2 -freciprocal-math", DIVIDED),
    ("clang", "-O2 -fno-signed-zeros", UNSIGNED),
    ("clang", "-O2 -fno-honor-nans", "NaN counts as a number"),
    ("clang", "-O2 -fno-honor-infinities", "infinity counts as a number"),
)


def reported(folder: Path, compiler: str, flags: Sequence[str]) -> str:
    """The errors of the compiler, or else what both parts of the core say."""
    machine = replace(machine_of(BOUNDED), name="bounded")
    write({**c99.generate(machine), "main.c": MAIN}, folder)
    sources = ["main.c", "bounded_monitor.c", "bounded_reactor.c"]
    command = [compiler, "-std=c99", "-ffp-contract=off", *flags, *sources, "-lm", "-o", "main"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode:
        return done.stderr
    said = subprocess.run([folder / "main"], stdout=subprocess.PIPE, text=True, check=True).stdout
    of_monitor, of_reactor = said.splitlines()
    assert of_monitor == of_reactor
    return of_monitor


@each_c_compiler
@pytest.mark.parametrize("flags", SAFE)
def test_flags_that_change_nothing(compiler: str, flags: str, tmp_path: Path) -> None:
    assert reported(tmp_path, compiler, flags.split()) == RIGHT


@pytest.mark.parametrize(
    ("compiler", "flags", "expected"),
    [pytest.param(*each, marks=needs({"gcc": GCC, "clang": CLANG}[each[0]])) for each in UNSAFE],
)
def test_flags_that_change_results(
    compiler: str, flags: str, expected: str, tmp_path: Path
) -> None:
    assert expected in reported(tmp_path, compiler, flags.split())


@needs(X86)
@each_c_compiler
@pytest.mark.parametrize("mode", MODES)
def test_modes_of_the_processor(compiler: str, mode: str, tmp_path: Path) -> None:
    assert MODES[mode] in reported(tmp_path, compiler, ["-O2", f"-DMODE={mode}"])


@each_c_compiler
def test_contraction(compiler: str, tmp_path: Path) -> None:
    """Only where the processor has the instruction."""
    flags = ["-O2", "-ffp-contract=fast", "-march=native"]
    has_it = "fma" in Path("/proc/cpuinfo").read_text(encoding="utf-8")
    assert (CONTRACTED if has_it else RIGHT) in reported(tmp_path, compiler, flags)
