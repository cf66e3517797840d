"""Numbers beside elements (S74) are the same in all engines, where each rule looks at such."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hypothesis import given, settings

from rossmarie import ir
from rossmarie.engines.python_monitor import PythonMonitor
from rossmarie.interpreter import Interpreter
from rossmarie.native import load_native
from rossmarie.targets.c99 import generate_loadable
from rossmarie.targets.python import source
from support.beside import cases_beside, machines_beside
from support.c_compiler import needs_c
from support.depth import examples, phases_of_compiled
from support.machines import Case, observe


@pytest.fixture(scope="module", autouse=True)
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


@given(machines_beside())
def test_such_machines_are_well_formed(machine: ir.Machine) -> None:
    ir.verify(machine)
    assert ir.beside(machine)


@settings(max_examples=examples(4))
@given(cases_beside())
def test_python_is_what_the_interpreter_is(case: Case) -> None:
    machine, trace = case
    wanted = observe(Interpreter(machine), trace)
    assert observe(PythonMonitor(machine, source(machine)), trace) == wanted


@needs_c
@settings(phases=phases_of_compiled(), max_examples=examples(1))
@given(cases_beside())
def test_c_is_what_the_interpreter_is(case: Case) -> None:
    machine, trace = case
    assert observe(load_native(machine, generate_loadable(machine)), trace) == observe(
        Interpreter(machine), trace
    )
