"""The generated C behaves as the interpreter does, bit for bit, on random machines and traces.

Once as it runs in this process; once as a program under the address and undefined-behaviour
sanitizers, which cannot be loaded into Python, with strict warnings on.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import Phase, given, settings

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.native import NativeMonitor, build
from rossmarie.native.events import EventReader
from rossmarie.native.library import Library
from rossmarie.native.signatures import declarations, fields_of
from rossmarie.targets.c99 import generate, generate_loadable
from support.c_compiler import STRICT, needs_c, run, write
from support.c_replay import observations, program, trace_bytes
from support.machines import Step, cases, observe

pytestmark = needs_c

EXAMPLES = settings().max_examples
# Shrinking compiles hundreds of times: it is for whoever asks for the thorough profile.
GENERATE_ONLY = (Phase.explicit, Phase.reuse, Phase.generate)
PHASES = tuple(Phase) if EXAMPLES > 1000 else GENERATE_ONLY

SANITIZERS = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all")


@pytest.fixture(scope="module", autouse=True)
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


def quickly_built(machine: ir.Machine) -> NativeMonitor:
    """As `load_native` does, but less optimized and without Python's headers."""
    path = build(generate_loadable(machine), "host.c", "-O1")
    library = Library(path, declarations(fields_of(machine)))
    return NativeMonitor(machine, library, EventReader(machine))


@settings(phases=PHASES)
@given(cases())
def test_same_events_wakes_and_states(case: tuple[ir.Machine, list[Step]]) -> None:
    machine, trace = case
    assert observe(quickly_built(machine), trace) == observe(Interpreter(machine), trace)


@settings(phases=PHASES, max_examples=max(10, EXAMPLES // 4))
@given(cases())
def test_same_under_sanitizers(case: tuple[ir.Machine, list[Step]]) -> None:
    machine, trace = case
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write({**generate(machine), "replay.c": program(machine)}, folder)
        command = ["cc", "-std=c99", "-O1", *STRICT, *SANITIZERS, str(folder / "replay.c")]
        run([*command, "-o", folder / "replay", "-lm"])
        output = run([folder / "replay"], given=trace_bytes(machine, trace)).stdout
    assert observations(machine, output, len(trace)) == observe(Interpreter(machine), trace)
