"""Arrays: rules S22 to S26 of docs/explanation/semantics.md."""

import math

import pytest

from rossmarie.ir import (
    And,
    Count,
    Fold,
    Folding,
    Function,
    Not,
    Quantified,
    Quantifier,
    TruthValue,
)
from support.bench import Bench
from support.drafts import SECOND, Draft
from support.machines import INFINITY, NAN

F, T, U, L = TruthValue


def test_s22_functions_apply_to_each_element() -> None:
    draft = Draft()
    element = draft.elements()
    off = draft.apply(Function.SUBTRACT, element, draft.constant(3.0))
    distance = draft.apply(Function.ABSOLUTE, off)
    least = draft.signal(Fold(Folding.MINIMUM, distance))
    near, far = draft.above(distance, 1.5), draft.above(element, 3.5)
    both = draft.proposition(And((near, draft.proposition(Not(far)))))
    count = draft.signal(Count(both))
    bench = Bench(draft)
    bench.send(0, c0=[1.0, 2.5, 5.0])
    assert bench.signal(least) == 0.5
    assert bench.signal(count) == 1.0
    bench.send(1, c0=[1.0, INFINITY])  # abs(inf - 3) is no finite result
    assert math.isnan(bench.signal(least))


def test_s23_least_and_greatest_element() -> None:
    draft = Draft()
    element = draft.elements()
    least, greatest = (draft.signal(Fold(folding, element)) for folding in Folding)
    bench = Bench(draft)
    bench.send(0, c0=[3.0, -1.0, 2.0])
    assert (bench.signal(least), bench.signal(greatest)) == (-1.0, 3.0)
    bench.send(1, c0=[0.0, -0.0])
    assert math.copysign(1.0, bench.signal(least)) == -1.0
    bench.send(2, c0=[])
    assert math.isnan(bench.signal(least))


def test_s23_a_nan_element_makes_them_unknown() -> None:
    draft = Draft()
    least = draft.signal(Fold(Folding.MINIMUM, draft.elements()))
    bench = Bench(draft)
    for elements in ([NAN, 1.0], [1.0, NAN], [1.0, NAN, 2.0]):
        bench.send(0, c0=elements)
        assert math.isnan(bench.signal(least))


def test_s24_count() -> None:
    draft = Draft()
    count = draft.signal(Count(draft.above(draft.elements(), 0.0)))
    bench = Bench(draft)
    seen = []
    for elements in ([1.0, -1.0, 2.0], [-1.0], [1.0, NAN], []):
        bench.send(0, c0=elements)
        seen.append(bench.signal(count))
    assert seen[:2] == [2.0, 0.0]
    assert all(map(math.isnan, seen[2:]))


@pytest.mark.parametrize(
    ("elements", "some", "every"),
    [
        ([1.0, 2.0], T, T),
        ([1.0, -1.0], T, F),
        ([-1.0, -1.0], F, F),
        ([1.0, NAN], T, U),
        ([-1.0, NAN], U, F),
        ([], U, U),
    ],
)
def test_s25_any_and_all(elements: list[float], some: TruthValue, every: TruthValue) -> None:
    draft = Draft()
    positive = draft.above(draft.elements(), 0.0)
    some_proposition, every_proposition = (
        draft.proposition(Quantified(which, positive)) for which in Quantifier
    )
    bench = Bench(draft)
    bench.send(0, c0=elements)
    assert (bench.proposition(some_proposition), bench.proposition(every_proposition)) == (
        some,
        every,
    )


def test_s26_results_hold_until_the_next_message_or_expiry() -> None:
    draft = Draft()
    least = draft.signal(Fold(Folding.MINIMUM, draft.elements(timeout_ns=SECOND)))
    draft.read()
    bench = Bench(draft)
    bench.send(0, c0=[4.0, 5.0])
    bench.send(0.5, c1=0.0)
    assert bench.signal(least) == 4.0
    bench.advance(1)
    assert math.isnan(bench.signal(least))
