"""The generated C behaves as the interpreter does, bit for bit, on random machines and traces."""

from __future__ import annotations

from hypothesis import given
from support.machines import Step, cases, observe

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.native import load_native
from rossmarie.targets.c99 import generate_loadable


@given(cases())
def test_same_events_wakes_and_states(case: tuple[ir.Machine, list[Step]]) -> None:
    machine, trace = case
    native = load_native(machine, generate_loadable(machine))
    assert observe(native, trace) == observe(Interpreter(machine), trace)
