"""A guard decides the same in C and in Python, bit for bit, on random machines and events."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hypothesis import given, settings

from rossmarie import ir
from rossmarie.engines import PythonGuard
from rossmarie.native import NativeGuard, load_native_guard
from rossmarie.targets.c99 import generate_guard
from rossmarie.targets.python import source
from support.c_compiler import needs_c
from support.depth import examples, phases_of_compiled
from support.guards import GuardCase, guard_cases, observe_guard

pytestmark = needs_c


@pytest.fixture(scope="module", autouse=True)
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


def native(machine: ir.Machine) -> NativeGuard:
    return load_native_guard(machine, generate_guard(machine))


@settings(phases=phases_of_compiled(), max_examples=examples(0.5))
@given(guard_cases())
def test_same_decisions_in_c_and_in_python(case: GuardCase) -> None:
    in_c, in_python = native(case.machine), PythonGuard(case.machine, source(case.machine))
    for course in case.courses:
        wanted = observe_guard(in_python.fresh(), case.machine, course)
        assert observe_guard(in_c.fresh(), case.machine, course) == wanted
