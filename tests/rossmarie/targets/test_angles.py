"""Angles are the same to the last bit in the interpreter, in C at all levels and in Python."""

from __future__ import annotations

import inspect
import math
import random
import struct
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest

from rossmarie.core import Function, defined
from rossmarie.core.expressions import subfunctions_of
from rossmarie.interpreter import arithmetic
from rossmarie.targets.c99 import functions as in_c
from rossmarie.targets.formulas import FunctionDefinition, definition_of, definition_of_subfunction
from rossmarie.targets.python import functions as in_python
from rossmarie.targets.python import parts
from support.c_compiler import STRICT, each_c_compiler, run
from support.depth import is_deep

ANGLES = (Function.ROLL, Function.PITCH, Function.YAW)
COUNT = 200_000 if is_deep() else 5_000
LEVELS = ("-O0", "-O2", "-O3 -march=native")
_PROGRAM = """\
#include <math.h>
#include <stdio.h>

{functions}
int main(void)
{{
    double q[4];
    while (fread(q, sizeof q, 1, stdin) == 1) {{
        const double found[] = {{{calls}}};
        fwrite(found, sizeof found, 1, stdout);
    }}
    return 0;
}}
"""


def orientations() -> Iterator[tuple[float, ...]]:
    """Quaternions of any length, many of them upright, upside down, or turned by quarters."""
    chance = random.Random(4)
    few = (0.0, -0.0, 1.0, -1.0, 0.5, 2.0**-30, 1e-160, 1e160, math.nan)
    for _ in range(COUNT):
        yield tuple(chance.gauss(0.0, 1.0) for _ in range(4))
        yield tuple(chance.choice(few) * chance.uniform(0.9, 1.1) for _ in range(4))
        yield tuple(chance.choice(few) for _ in range(4))


def definitions() -> list[FunctionDefinition]:
    """The functions, each after those that it applies."""
    applied = dict.fromkeys(part for each in ANGLES for part in subfunctions_of(defined(each, 4)))
    return [
        *map(definition_of_subfunction, applied),
        *(definition_of(each, 4) for each in ANGLES),
    ]


def bits(value: float) -> bytes:
    """A number to the last bit; what is not a number is all the same."""
    return struct.pack("=d", math.nan if math.isnan(value) else value)


@pytest.fixture(scope="module")
def given() -> list[tuple[float, ...]]:
    return list(orientations())


@pytest.fixture(scope="module")
def meant(given: Sequence[tuple[float, ...]]) -> list[bytes]:
    return [bits(arithmetic.plain(angle, each)) for each in given for angle in ANGLES]


@each_c_compiler
@pytest.mark.parametrize("level", LEVELS)
def test_angles_in_c_are_those_of_the_interpreter(
    compiler: str,
    level: str,
    given: Sequence[tuple[float, ...]],
    meant: Sequence[bytes],
    tmp_path: Path,
) -> None:
    calls = ", ".join(f"{each.value}_of(q[0], q[1], q[2], q[3])" for each in ANGLES)
    text = _PROGRAM.format(functions="\n".join(map(in_c.function, definitions())), calls=calls)
    (tmp_path / "angles.c").write_text(text, encoding="utf-8")
    built = tmp_path / "angles"
    options = ["-std=c99", *level.split(), *STRICT]
    run([compiler, *options, tmp_path / "angles.c", "-o", built, "-lm"])
    found = run([built], given=b"".join(struct.pack("=4d", *each) for each in given)).stdout
    assert [bits(value) for (value,) in struct.iter_unpack("=d", found)] == meant


def test_angles_in_python_are_those_of_the_interpreter(
    given: Sequence[tuple[float, ...]], meant: Sequence[bytes]
) -> None:
    copied = [inspect.getsource(parts.divide), inspect.getsource(parts.square_root)]
    text = "\n".join([*copied, *map(in_python.function, definitions())])
    names: dict[str, Any] = {"math": math, "NAN": math.nan, "INF": math.inf}
    exec(text, names)
    assert [bits(names[f"{each.value}_of"](*one)) for one in given for each in ANGLES] == meant
