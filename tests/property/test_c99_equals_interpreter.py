"""The generated C behaves as the interpreter does, bit for bit, on random machines and traces.

Once as it runs in this process; once as a program under the address and undefined-behaviour
sanitizers, which cannot be loaded into Python, with strict warnings on.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.native import NativeMonitor, build, fit
from rossmarie.native.events import EventReader
from rossmarie.native.library import NativeLibrary
from rossmarie.native.monitor import with_own
from rossmarie.native.signatures import declarations, fields_of
from rossmarie.targets.c99 import generate_loadable
from support.batches import in_batches, one_by_one, updates_of
from support.c_batches import batch_bytes, of_batch, program_with_batch
from support.c_compiler import STRICT, needs_c, run, write
from support.c_replay import knowledge, known, observations, table_bytes, trace_bytes
from support.depth import examples, is_deep, phases_of_compiled
from support.machines import exactly, observe
from support.runs import Case, FastCalls, in_chunks, row_by_row, whole_cases

pytestmark = needs_c

# Optimizing takes half of the time of such a compilation.
SANITIZERS = (
    "-O1" if is_deep() else "-O0",
    "-fsanitize=address,undefined",
    "-fno-sanitize-recover=all",
)
_PACKED = "int host_packed(host *, int, int64_t, double *);"


@pytest.fixture(scope="module", autouse=True)
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


def quickly_built(machine: ir.Machine) -> Callable[[], NativeMonitor]:
    """As `load_native` does, but less optimized and without Python's headers; built once, for as
    many monitors as are asked for.
    """
    content = build(with_own(generate_loadable(machine)), "batch.c", "-O1")
    library = NativeLibrary(content, declarations(fields_of(machine)) + _PACKED)
    return lambda: NativeMonitor(machine, library, EventReader(machine))


class PackedCalls(FastCalls):
    """The same by the function that is behind `update_call` where Python's headers are at hand."""

    def __init__(self, machine: ir.Machine, native: NativeMonitor) -> None:
        super().__init__(machine, native)
        self._native = native

    def call(self, channel: int, at_ns: int, numbers: list[float]) -> int:
        library = self._native.library
        memory = library.new("double[]", numbers or [0.0])
        packed = library.function("host_packed")
        return int(packed(self._native.host, channel, at_ns, memory))


@settings(phases=phases_of_compiled(), max_examples=examples(2))
@given(whole_cases())
def test_same_events_wakes_and_states(case: Case) -> None:
    machine, trace, table = case.machine, case.trace, case.table
    native = quickly_built(machine)
    wanted = observe(Interpreter(machine), trace)
    assert observe(native(), trace) == wanted
    assert observe(FastCalls(machine, native()), trace) == wanted
    assert observe(PackedCalls(machine, native()), trace) == wanted
    rows = list(row_by_row(case))
    assert list(in_chunks(native().bind(table.times_ns, table.columns), case)) == rows
    assert in_batches(machine, native(), trace, case.chunk) == one_by_one(machine, trace)
    run = native().run(table.times_ns, table.columns)
    assert [exactly(event) for event in run.events] == [event for part, _ in rows for event in part]


def restored(machine: ir.Machine, latched: Sequence[int]) -> Interpreter:
    interpreter = Interpreter(machine)
    for rule in latched:
        if 0 <= rule < len(machine.rules):
            interpreter.latch(rule)
    return interpreter


@settings(phases=phases_of_compiled(), max_examples=examples(0.5))
@given(whole_cases(), st.lists(st.integers(-1, 3), max_size=3))
def test_same_under_sanitizers(case: Case, latched: list[int]) -> None:
    """The program says more than the loaded monitor: it restores rules, and tells of inputs and
    watches.
    """
    machine, trace, table = case.machine, case.trace, case.table
    columns = fit(machine, table.times_ns, table.columns)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        files = with_own(generate_loadable(machine))
        write({**files, "replay.c": program_with_batch(machine)}, folder)
        command = ["cc", "-std=c99", *STRICT, *SANITIZERS, str(folder / "replay.c")]
        run([*command, "-o", folder / "replay", "-lm"])
        given = trace_bytes(machine, trace, latched) + table_bytes(columns)
        given += batch_bytes(machine, updates_of(trace))
        output = run([folder / "replay"], given=given).stdout
    _, *found, of_table, _ = observations(machine, output, len(trace) + 3)
    assert of_batch(machine, output, len(trace) + 2) == one_by_one(machine, trace)
    interpreter = restored(machine, latched)
    knows = [known(machine, interpreter)]
    for step, observation in zip(trace, found, strict=True):
        assert [observation] == observe(interpreter, [step])
        knows.append(known(machine, interpreter))
    assert knowledge(output)[:-2] == knows
    rows = list(row_by_row(case))
    assert list(of_table.events) == [event for part, _ in rows for event in part]
    assert list(of_table.active) == rows[-1][1][-1]
