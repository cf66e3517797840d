"""Every fault that is seeded in the generated C is noticed."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor

import pytest

from mutation.bench import GENERATED_TESTS, TRACES, Bench
from mutation.faults import EQUIVALENT, MONITOR, Equivalent, Fault
from mutation.reactor_faults import REACTOR
from support.c_compiler import needs_c
from support.depth import deep, is_deep

pytestmark = needs_c

FAULTS = (*MONITOR, *REACTOR)
IN_EACH_RUN = FAULTS[::3]
Noticed = Mapping[Fault, frozenset[str]]


@pytest.fixture(scope="module")
def bench() -> Bench:
    return Bench()


@pytest.fixture(scope="module")
def noticed(bench: Bench) -> Iterator[Noticed]:
    with ThreadPoolExecutor(2) as pool:
        faults = FAULTS if is_deep() else IN_EACH_RUN
        yield dict(zip(faults, pool.map(bench.noticed, faults), strict=True))


def test_undamaged_c_is_the_interpreter(bench: Bench) -> None:
    wanted, found = bench.expected_of_monitor()
    assert found == wanted
    wanted, found = bench.expected_of_reactor()
    assert found == wanted


def test_each_fault_is_made_at_one_place(bench: Bench) -> None:
    for fault in FAULTS:
        bench.damaged(fault)


@pytest.mark.parametrize(
    "fault",
    [*IN_EACH_RUN, *deep(fault for fault in FAULTS if fault not in IN_EACH_RUN)],
    ids=lambda fault: fault.name,
)
def test_a_fault_is_noticed(noticed: Noticed, fault: Fault) -> None:
    assert noticed[fault]


@pytest.mark.parametrize("equivalent", EQUIVALENT, ids=lambda each: each.fault.name)
def test_what_changes_nothing_is_not_noticed(bench: Bench, equivalent: Equivalent) -> None:
    assert not bench.noticed(equivalent.fault), equivalent.reason


@pytest.mark.deep
def test_the_rates_are_reported(
    noticed: Noticed, record_property: Callable[[str, object], None]
) -> None:
    lines = ["mutants that are noticed"]
    for who, faults in ((GENERATED_TESTS, MONITOR), (TRACES, FAULTS)):
        found = [fault for fault in faults if who in noticed[fault]]
        lines.append(f"  by {who}: {len(found)} of {len(faults)}")
    record_property("reported", "\n".join(lines))
    assert set().union(*noticed.values()) == {GENERATED_TESTS, TRACES}
