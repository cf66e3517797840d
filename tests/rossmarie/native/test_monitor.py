"""The native monitor: same events as the interpreter, whichever way messages are given."""

from __future__ import annotations

import gc
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, Event
from rossmarie.native import ColumnError, NativeMonitor, build, load_native
from rossmarie.native import monitor as native_monitor
from rossmarie.targets.c99 import generate_loadable
from support.c99_cases import CASES
from support.c_compiler import needs_c
from support.drafts import SECOND
from support.machines import exactly
from support.parts import MOUNTS, needs

pytestmark = needs_c

TICK = SECOND // 10


@pytest.fixture(autouse=True, scope="module")
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> object:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


def load(case: str) -> NativeMonitor:
    machine = CASES[case]()
    return load_native(machine, generate_loadable(machine))


def without_headers(case: str) -> NativeMonitor:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(native_monitor, "_HEADERS", Path("/nowhere"))
        return load(case)


def bits(events: list[Event]) -> list[object]:
    return [exactly(event) for event in events]


# Speeds and whether the robot is docked, at 10 Hz: fast for 3 s, then creeping, then fast again.
SPEEDS = np.array([0.0] + [0.6] * 30 + [0.15] * 5 + [0.6] * 25 + [np.nan] * 3)
DOCKED = np.array([True] * 3 + [False] * 50 + [True] * 11)
TIMES = np.arange(len(SPEEDS), dtype=np.int64) * TICK


def expected() -> list[Event]:
    interpreter = Interpreter(CASES["thresholds"]())
    events: list[Event] = []
    for at_ns, speed, docked in zip(TIMES, SPEEDS, DOCKED, strict=True):
        values = ChannelValues({0: float(speed), 1: float(docked)})
        events += interpreter.update(int(at_ns), {0: values})
    assert len(events) >= 3, "the trace tells something"
    return events


# --- one message at a time -------------------------------------------------------------------


def fast_function() -> tuple[NativeMonitor, Callable[..., int]]:
    monitor = load("thresholds")
    return monitor, monitor.update_call(0)


def fallback_function() -> tuple[NativeMonitor, Callable[..., int]]:
    monitor = without_headers("thresholds")
    return monitor, monitor.update_call(0)


@pytest.mark.parametrize("make", [fast_function, fallback_function])
def test_fast_calls_say_how_many_events_wait(
    make: Callable[[], tuple[NativeMonitor, Callable[..., int]]],
) -> None:
    monitor, update = make()
    waiting = 0
    for at_ns, speed, docked in zip(TIMES, SPEEDS, DOCKED, strict=True):
        waiting += update(int(at_ns), speed, bool(docked))
    events = monitor.take_events()
    assert len(events) == waiting
    assert bits(events) == bits(expected())
    assert monitor.take_events() == []


@pytest.mark.parametrize("make", [fast_function, fallback_function])
def test_fast_calls_refuse_nonsense(
    make: Callable[[], tuple[NativeMonitor, Callable[..., int]]],
) -> None:
    monitor, update = make()
    with pytest.raises(TypeError):
        update(0, 1.0)
    with pytest.raises(TypeError):
        update(0, "fast", True)
    with pytest.raises(OverflowError):
        update(2**70, 1.0, True)
    assert update(ir.LATEST_NS, 1.0, True) == -1
    assert monitor.next_wake() is None


def test_a_fast_function_keeps_its_monitor_alive() -> None:
    update = load("thresholds").update_call(0)
    gc.collect()
    assert [update(i * TICK, 0.15, False) for i in range(3)] == [1, 0, 0]


def test_a_channel_with_arrays_has_no_fast_call() -> None:
    with pytest.raises(ValueError, match="arrays"):
        load("arrays").update_call(0)


def test_events_of_fast_calls_and_of_updates_are_kept_apart() -> None:
    monitor = load("thresholds")
    assert monitor.update_call(0)(0, 0.15, False) == 1
    assert monitor.update(TICK, {0: ChannelValues({0: 0.7, 1: 0.0})}) == []
    assert [event.at_ns for event in monitor.reset(2 * TICK) if isinstance(event, ir.Verdict)] == [
        2 * TICK
    ]
    assert len(monitor.take_events()) == 1


def test_instants_out_of_range_are_refused() -> None:
    monitor = load("thresholds")
    for at_ns in (ir.LATEST_NS, ir.EARLIEST_NS, 2**80):
        with pytest.raises(ValueError, match="out of range"):
            monitor.update(at_ns, {0: ChannelValues({0: 1.0})})
        with pytest.raises(ValueError, match="out of range"):
            monitor.advance(at_ns)
    assert monitor.next_wake() is None


def test_arrays_of_any_length() -> None:
    machine = CASES["arrays"]()
    native, interpreter = load("arrays"), Interpreter(machine)
    for step, ranges in enumerate([[], [1.0], [0.1, 2.0], [0.9] * 5000, [float("nan")], [0.9]]):
        message = {0: ChannelValues({}, {0: ranges})}
        at_ns = step * TICK
        assert bits(native.update(at_ns, message)) == bits(interpreter.update(at_ns, message))
        assert native.active == interpreter.active


def test_runs_leave_the_events_of_fast_calls_alone() -> None:
    monitor = load("thresholds")
    assert monitor.update_call(0)(-TICK, 0.15, False) == 1
    assert monitor.run(TIMES, columns()).events
    assert [exactly(event)[1] for event in monitor.take_events()] == [-TICK]  # type: ignore[index]


def test_two_monitors_do_not_share_anything() -> None:
    one, other = load("thresholds"), load("thresholds")
    one.update(0, {0: ChannelValues({0: 0.15, 1: 0.0})})
    assert one.active == (False, True)
    assert other.active == (False, False)


# --- whole columns ---------------------------------------------------------------------------


def columns() -> dict[str, np.ndarray]:
    return {"input_0": SPEEDS, "input_1": DOCKED}


def test_run_is_as_one_update_a_row() -> None:
    result = load("thresholds").run(TIMES, columns(), active=True)
    assert bits(result.events) == bits(expected())
    interpreter = Interpreter(CASES["thresholds"]())
    for row, (speed, docked) in enumerate(zip(SPEEDS, DOCKED, strict=True)):
        values = ChannelValues({0: float(speed), 1: float(docked)})
        interpreter.update(int(TIMES[row]), {0: values})
        assert tuple(result.active[row]) == interpreter.active


@pytest.mark.parametrize("make", [load, without_headers])
def test_chunks_are_as_a_whole(make: Callable[[str], NativeMonitor]) -> None:
    bound = make("thresholds").bind(TIMES, columns())
    gc.collect()
    chunks = [bound.run(start, min(start + 7, len(TIMES))) for start in range(0, len(TIMES), 7)]
    assert bits([event for chunk in chunks for event in chunk.events]) == bits(expected())


def test_any_number_type_and_layout_of_columns() -> None:
    table = np.stack([SPEEDS * 100, DOCKED], axis=1)
    whole = np.nan_to_num(table).astype(np.int16)
    given = {"input_0.slot_0": whole[:, 0] // 100, "input_1": table[:, 1]}
    floats = {"input_0": (whole[:, 0] // 100).astype(float), "input_1": DOCKED}
    found, wanted = load("thresholds").run(TIMES, given), load("thresholds").run(TIMES, floats)
    assert bits(found.events) == bits(wanted.events)


def test_several_channels_are_updated_together() -> None:
    machine = CASES["timeouts"]()
    times = np.array([0, SECOND, 2 * SECOND, 2 * SECOND, SECOND], np.int64)
    speeds, batteries = np.array([2.0, 0.0, 0.0, 0.0, 0.0]), np.array([12.0, 11, 12, 12, 10])
    interpreter, wanted = Interpreter(machine), []
    for row, at_ns in enumerate(times):
        messages = {0: ChannelValues({0: speeds[row]}), 1: ChannelValues({1: batteries[row]})}
        wanted += interpreter.update(int(at_ns), messages)
    found = load("timeouts").run(times, {"input_0": speeds, "input_1": batteries}).events
    assert bits(found) == bits(wanted)


def test_active_is_known_only_if_asked_for() -> None:
    result = load("thresholds").run(TIMES, columns())
    with pytest.raises(ValueError, match="active=True"):
        _ = result.active


@pytest.mark.parametrize(
    ("given", "complaint"),
    [
        ({"input_0": SPEEDS}, "no columns for input_1"),
        ({"input_0": SPEEDS, "input_1": DOCKED, "speed": SPEEDS}, "no rule reads"),
        ({"input_0": SPEEDS[1:], "input_1": DOCKED}, "shape"),
        ({"input_0": SPEEDS, "input_0.slot_0": SPEEDS, "input_1": DOCKED}, "2 columns"),
        ({"input_0": SPEEDS * 1j, "input_1": DOCKED}, "not numbers"),
    ],
)
def test_columns_that_do_not_fit(given: dict[str, np.ndarray], complaint: str) -> None:
    with pytest.raises(ColumnError, match=complaint):
        load("thresholds").run(TIMES, given)


def test_instants_are_integers() -> None:
    with pytest.raises(ColumnError, match="int64"):
        load("thresholds").run(TIMES.astype(float), columns())


@pytest.mark.parametrize("elements", [0, 1, 7])
def test_arrays_come_as_tables(elements: int) -> None:
    table = np.random.default_rng(elements).random((40, elements)) * 2
    times = np.arange(40) * TICK
    interpreter, wanted = Interpreter(CASES["arrays"]()), []
    for at_ns, row in zip(times.tolist(), table.tolist(), strict=True):
        wanted += interpreter.update(at_ns, {0: ChannelValues({}, {0: row})})
    assert bits(load("arrays").run(times, {"input_0": table}).events) == bits(wanted)


@pytest.mark.parametrize("make", [load, without_headers])
def test_a_run_stops_at_an_instant_out_of_range(make: Callable[[str], NativeMonitor]) -> None:
    """Columns are looked at before, but C relies on nothing: here they change after that."""
    times = TIMES.copy()
    monitor = make("thresholds")
    bound = monitor.bind(times, columns())
    times[5] = ir.LATEST_NS
    with pytest.raises(ValueError, match="row 5"):
        bound.run()
    assert monitor.run(TIMES[5:], {k: v[5:] for k, v in columns().items()}).events


def test_rows_that_are_not_there() -> None:
    bound = load("thresholds").bind(TIMES, columns())
    with pytest.raises(IndexError):
        bound.run(0, len(TIMES) + 1)


# --- lack of memory --------------------------------------------------------------------------


def without_memory() -> NativeMonitor:
    """Its log of events can never grow."""
    machine = CASES["thresholds"]()
    files = generate_loadable(machine)
    start = "#include <stdlib.h>\n"
    assert start in files["host.c"]
    starved = files["host.c"].replace(start, f"{start}#define realloc(old, size) NULL\n")
    return load_native(machine, {**files, "host.c": starved})


def test_lost_events_are_reported_even_if_none_is_left() -> None:
    creeping = {0: ChannelValues({0: 0.15, 1: 0.0})}
    with pytest.raises(MemoryError, match="lost"):
        without_memory().update(0, creeping)
    with pytest.raises(MemoryError):
        without_memory().run(TIMES, columns())


def test_lost_events_of_fast_calls_are_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monitor = without_memory()
    with pytest.raises(MemoryError):
        monitor.update_call(0)(0, 0.15, False)
    with pytest.raises(MemoryError, match="lost"):
        monitor.take_events()
    monkeypatch.setattr(native_monitor, "_HEADERS", Path("/nowhere"))
    monitor = without_memory()
    monitor.update_call(0)(0, 0.15, False)
    with pytest.raises(MemoryError, match="lost"):
        monitor.take_events()


# --- the cache -------------------------------------------------------------------------------


def test_a_library_that_cannot_be_loaded_is_built_again(monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[bool] = []

    def once_broken(*arguments: Any, rebuild: bool, **more: Any) -> bytes:
        calls.append(rebuild)
        return (
            build(*arguments, rebuild=rebuild, **more) if rebuild else b"\x7fELF and then nothing"
        )

    monkeypatch.setattr(native_monitor, "build", once_broken)
    assert load("thresholds").run(TIMES, columns()).events
    assert calls == [False, True]


def test_what_cannot_be_compiled_is_compiled_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Only a library that cannot be loaded is built again."""
    calls: list[object] = []

    def refuse(*arguments: object, **_: object) -> Path:
        calls.append(arguments)
        raise PermissionError("the cache is not for you")

    monkeypatch.setattr(native_monitor, "build", refuse)
    with pytest.raises(PermissionError):
        load("thresholds")
    assert len(calls) == 1


@needs(MOUNTS)
def test_temporary_files_need_not_be_executable(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As in a container with `--read-only --tmpfs /tmp`."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    machine = CASES["thresholds"]()
    subprocess.run(["mount", "-t", "tmpfs", "-o", "noexec", "tmpfs", tmp_path], check=True)
    try:
        files = generate_loadable(machine)
        another = files["host.c"] + "int never_loaded_before;\n"
        assert load_native(machine, {**files, "host.c": another}).run(TIMES, columns()).events
    finally:
        subprocess.run(["umount", "--lazy", tmp_path], check=True)
