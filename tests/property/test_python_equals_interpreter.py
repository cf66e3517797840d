"""The generated Python behaves as the interpreter does, bit for bit, on random machines."""

from __future__ import annotations

import math

from hypothesis import given, settings
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.driver.python_columns import PythonColumns
from rossmarie.engines.python_monitor import PythonMonitor
from rossmarie.interpreter import Interpreter
from rossmarie.native import fit
from rossmarie.targets.python import source
from support.depth import examples
from support.machines import Case as Traced
from support.machines import Step, calm_traces, cases, machines, observe
from support.runs import Case, FastCalls, in_chunks, row_by_row, whole_cases


class IntegerCalls(FastCalls):
    """Fast calls with integers wherever a number is one, as who calls by hand may write them."""

    def call(self, channel: int, at_ns: int, numbers: list[float]) -> int:
        return super().call(channel, at_ns, [_as_integer(number) for number in numbers])


def _as_integer(number: float) -> float:
    is_integer = math.isfinite(number) and number.is_integer() and str(number) != "-0.0"
    return int(number) if is_integer else number


@st.composite
def calm_cases(draw: st.DrawFn) -> Traced:
    machine = draw(machines())
    return machine, draw(calm_traces(machine))


def assert_same(machine: ir.Machine, trace: list[Step]) -> None:
    text = source(machine)
    wanted = observe(Interpreter(machine), trace)
    assert observe(PythonMonitor(machine, text), trace) == wanted
    assert observe(FastCalls(machine, PythonMonitor(machine, text)), trace) == wanted
    assert observe(IntegerCalls(machine, PythonMonitor(machine, text)), trace) == wanted


@settings(max_examples=examples(4))
@given(whole_cases())
def test_same_events_wakes_and_states(case: Case) -> None:
    assert_same(case.machine, case.trace)


@settings(max_examples=examples(4))
@given(calm_cases())
def test_same_where_most_messages_change_nothing(case: Traced) -> None:
    assert_same(*case)


class Restored(PythonMonitor):
    """A monitor that can be told which latched rules are active."""

    def latch(self, rule: int) -> None:
        self._generated.latch(rule)


@given(cases(), st.sets(st.integers(0, 3)))
def test_same_after_latched_rules_were_restored(case: Traced, latched: set[int]) -> None:
    machine, trace = case
    interpreter, restored = Interpreter(machine), Restored(machine, source(machine))
    for rule in latched & set(range(len(machine.rules))):
        interpreter.latch(rule)
        restored.latch(rule)
    assert restored.active == interpreter.active
    assert observe(restored, trace) == observe(interpreter, trace)


@given(whole_cases())
def test_columns_are_as_one_update_a_row(case: Case) -> None:
    fitting = fit(case.machine, case.table.times_ns, case.table.columns)
    monitor = PythonMonitor(case.machine, source(case.machine))
    bound = PythonColumns(case.machine, monitor, fitting)
    assert list(in_chunks(bound, case)) == list(row_by_row(case))
