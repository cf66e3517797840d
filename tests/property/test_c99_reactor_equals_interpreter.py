"""The generated reactor behaves as the interpreter's does, bit for bit, on random reactions and
events, under the address and undefined-behaviour sanitizers and with strict warnings on.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

from hypothesis import given, settings

from rossmarie.targets.c99 import generate
from support.c_compiler import STRICT, needs_c, run, write
from support.c_reacting import event_bytes, program, wanted
from support.depth import is_deep, phases_of_compiled
from support.reacting import ReactingCase, reacting_cases

pytestmark = needs_c

# Optimizing takes half of the time of such a compilation.
SANITIZERS = (
    "-O1" if is_deep() else "-O0",
    "-fsanitize=address,undefined",
    "-fno-sanitize-recover=all",
)


@settings(phases=phases_of_compiled())
@given(reacting_cases(max_events=40, has_ends_of_time=True))
def test_same_task_commands_states_wakes_and_bounds(case: ReactingCase) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write({**generate(case.machine), "react.c": program(case.machine)}, folder)
        command = ["cc", "-std=c99", *STRICT, *SANITIZERS, str(folder / "react.c")]
        run([*command, "-o", folder / "react", "-lm"])
        output = run([folder / "react"], given=event_bytes(case)).stdout
    assert output.decode("ascii").splitlines() == wanted(case)
