"""Batches for the native monitor: what does not fit, and what is stale."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rossmarie import ir
from rossmarie.ir import Batch, ChannelValues
from rossmarie.native import NativeMonitor, load_native
from rossmarie.native import batches as native_batches
from rossmarie.native import monitor as native_monitor
from rossmarie.recordings.batches import batched
from rossmarie.recordings.model import Update
from rossmarie.targets.c99 import generate_loadable
from support.batches import in_batches, one_by_one
from support.c99_cases import CASES
from support.c_compiler import needs_c
from support.drafts import SECOND
from support.machines import Step
from support.machines import Update as Arrives

pytestmark = needs_c

MACHINE = CASES["thresholds"]()
SPEEDS = [0.0, *[0.6] * 5, 0.15, 0.6]


@pytest.fixture(autouse=True, scope="module")
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> object:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


def load() -> NativeMonitor:
    return load_native(MACHINE, generate_loadable(MACHINE))


def trace() -> list[Step]:
    """Rows so far apart that timers are due in between."""
    return [
        Arrives(place * 4 * SECOND, {0: ChannelValues({0: speed, 1: 0.0})})
        for place, speed in enumerate(SPEEDS)
    ]


def batch() -> Batch:
    steps = (step for step in trace() if isinstance(step, Arrives))
    (found,) = batched(MACHINE, [Update(step.at_ns, step.messages) for step in steps])
    return found


@pytest.mark.parametrize("room", [1, 2, 3])
def test_samples_for_which_there_is_no_room_come_afterwards(
    monkeypatch: pytest.MonkeyPatch, room: int
) -> None:
    monkeypatch.setattr(native_batches, "_ROOM", room - len(SPEEDS))
    events, samples = in_batches(MACHINE, load(), trace(), len(SPEEDS))
    assert (events, samples) == one_by_one(MACHINE, trace())
    assert len(samples) > len(SPEEDS)


def test_without_headers_of_python(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(native_monitor, "_HEADERS", Path("/nowhere"))
    assert in_batches(MACHINE, load(), trace(), 3) == one_by_one(MACHINE, trace())


def test_an_instant_out_of_range_is_refused() -> None:
    late = batch()
    late.times_ns[5] = ir.LATEST_NS
    with pytest.raises(ValueError, match="update 5"):
        load().take(late, [0])


def test_lost_events_are_reported() -> None:
    files = generate_loadable(MACHINE)
    start = "#include <stdlib.h>\n"
    assert start in files["host.c"]
    starved = files["host.c"].replace(start, f"{start}#define realloc(old, size) NULL\n")
    monitor = load_native(MACHINE, {**files, "host.c": starved})
    with pytest.raises(MemoryError, match="lost"):
        monitor.take(batch(), [0])


def test_events_of_calls_before_a_batch_wait_for_those_who_ask() -> None:
    monitor, alone = load(), load()
    for each in (monitor, alone):
        call = each.update_call(0)
        assert call(0, 0.6, 0.0) + call(4 * SECOND, 0.6, 0.0) > 0
    later = batch()
    monitor.take(replace(later, times_ns=later.times_ns + 5 * SECOND), [])
    assert monitor.take_events() == alone.take_events()


def test_a_signal_that_is_nowhere_is_unknown() -> None:
    constants = [i for i, s in enumerate(MACHINE.signals) if isinstance(s.node, ir.Constant)]
    assert constants
    taken = load().take(batch(), constants)
    assert np.isnan(taken.values).all()
