"""Numbers beside elements (S74) are the same in all engines, where each rule looks at such."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hypothesis import given, settings

from rossmarie import ir
from rossmarie.engines.python_monitor import PythonMonitor
from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, Compare, Comparison, Element, Held, Quantified, Quantifier
from rossmarie.native import load_native
from rossmarie.targets.c99 import generate_loadable
from rossmarie.targets.python import source
from support.beside import cases_beside, machines_beside
from support.c_compiler import needs_c
from support.depth import examples, phases_of_compiled
from support.drafts import SECOND, Draft
from support.machines import Advance, Case, Update, observe

TICK = SECOND // 10


@pytest.fixture(scope="module", autouse=True)
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


def _empty_list_while_its_limit_expires() -> Case:
    """A number beside elements expires at the instant of a message with an empty list."""
    draft = Draft()
    column = draft.column(draft.list_of(draft.input(draft.channel()), 2))
    element = draft.signal(Element(column))
    beside = draft.read(3 * TICK)
    below = draft.proposition(Compare(Comparison.LESS_OR_EQUAL, element, beside))
    everywhere = draft.proposition(Quantified(Quantifier.ALL, below))
    draft.rule(draft.proposition(Held(everywhere, 7 * TICK)))
    empty = {0: ChannelValues(slots={}, arrays={0: []})}
    number = {1: ChannelValues(slots={0: 1.0}, arrays={})}
    return draft.machine(), [Update(0, empty | number), Update(3 * TICK, empty), Advance(7 * TICK)]


def test_a_truth_value_that_a_message_restores_at_once_has_not_changed() -> None:
    machine, trace = _empty_list_while_its_limit_expires()
    assert observe(Interpreter(machine), trace)[-1].active == (True,)
    assert observe(PythonMonitor(machine, source(machine)), trace)[-1].active == (True,)


@needs_c
def test_c_restores_a_truth_value_at_once() -> None:
    machine, trace = _empty_list_while_its_limit_expires()
    loaded = load_native(machine, generate_loadable(machine))
    assert observe(loaded, trace) == observe(Interpreter(machine), trace)


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
