"""Lists of messages: rules S51 to S54 of docs/explanation/semantics.md."""

import math

import pytest

from rossmarie.ir import (
    And,
    ChannelValues,
    Compare,
    Comparison,
    Count,
    Element,
    FieldKind,
    Fold,
    Folding,
    Function,
    MalformedMachine,
    Quantified,
    Quantifier,
    Sampled,
    Sampling,
    TruthValue,
    verify,
)
from support.bench import Bench
from support.drafts import SECOND, Draft
from support.machines import INFINITY, NAN

F, T, U, L = TruthValue


class Objects:
    """A list of up to three objects with a distance and a speed, and all that is asked of it."""

    def __init__(self, timeout_ns: int | None = None) -> None:
        self.draft = draft = Draft()
        objects = draft.list_of(draft.input(draft.channel(), timeout_ns), most=3)
        self.distances, self.speeds = draft.column(objects), draft.column(objects)
        self.distance, self.speed = (
            draft.signal(Element(column)) for column in (self.distances, self.speeds)
        )
        near = draft.proposition(Compare(Comparison.LESS, self.distance, draft.constant(1.5)))
        self.coming = draft.proposition(And((near, draft.above(self.speed, 0.0))))
        self.any, self.all = (
            draft.proposition(Quantified(which, self.coming)) for which in Quantifier
        )
        self.count = draft.signal(Count(self.coming))
        self.nearest, self.farthest = (
            draft.signal(Fold(folding, self.distance)) for folding in Folding
        )

    def bench(self) -> Bench:
        return Bench(self.draft)

    def send(
        self, bench: Bench, distances: list[float], speeds: list[float], at_ns: int = 0
    ) -> None:
        columns = {self.distances: distances, self.speeds: speeds}
        bench.monitor.update(at_ns, {0: ChannelValues(arrays=columns)})

    def seen(self, bench: Bench) -> list[object]:
        numbers = (bench.signal(self.count), bench.signal(self.nearest))
        return [bench.proposition(self.any), bench.proposition(self.all), *map(_shown, numbers)]


def _shown(number: float) -> float | None:
    return None if math.isnan(number) else number


def test_s51_a_list_of_too_many_elements_is_not_known() -> None:
    objects = Objects()
    bench = objects.bench()
    objects.send(bench, [1.0, 2.0, 3.0], [1.0] * 3)
    assert objects.seen(bench) == [T, F, 1.0, 1.0]
    objects.send(bench, [1.0, 2.0, 3.0, 4.0], [1.0] * 4)
    assert objects.seen(bench) == [U, U, None, None]
    objects.send(bench, [5.0], [1.0])
    assert objects.seen(bench) == [F, F, 0.0, 5.0]


def test_s51_a_list_that_a_message_lacks_is_not_known() -> None:
    objects = Objects()
    bench = objects.bench()
    for columns in ({}, {objects.distances: [1.0]}, {objects.distances: [], objects.speeds: [1.0]}):
        bench.monitor.update(0, {0: ChannelValues(arrays=columns)})
        assert objects.seen(bench) == [U, U, None, None]


def test_s51_elements_are_converted_and_keep_infinities() -> None:
    draft = Draft()
    objects = draft.list_of(draft.input(draft.channel()), most=2)
    element = draft.signal(Element(draft.column(objects, scale=0.5, offset=1.0)))
    least = draft.signal(Fold(Folding.MINIMUM, element))
    bench = Bench(draft)
    bench.send(0, c0=[6.0, INFINITY])
    assert bench.signal(least) == 4.0
    bench.send(0, c0=[-INFINITY, 6.0])
    assert bench.signal(least) == -INFINITY


def test_s52_fields_of_one_element_meet() -> None:
    objects = Objects()
    bench = objects.bench()
    objects.send(bench, [1.0, 9.0], [-1.0, 1.0])  # one is near, another one is coming
    assert objects.seen(bench) == [F, F, 0.0, 1.0]
    objects.send(bench, [1.0, 9.0], [1.0, -1.0])
    assert objects.seen(bench) == [T, F, 1.0, 1.0]


def test_s52_functions_of_several_fields() -> None:
    draft = Draft()
    places = draft.list_of(draft.input(draft.channel()), most=4)
    x, y = (draft.signal(Element(draft.column(places))) for _ in "xy")
    farthest = draft.signal(Fold(Folding.MAXIMUM, draft.apply(Function.HYPOT, x, y)))
    bench = Bench(draft)
    bench.monitor.update(0, {0: ChannelValues(arrays={0: [3.0, 0.0], 1: [4.0, 1.0]})})
    assert bench.signal(farthest) == 5.0


def test_s52_texts_of_elements() -> None:
    draft = Draft(texts=("motor", "camera"))
    parts = draft.list_of(draft.input(draft.channel()), most=4)
    name = draft.signal(Element(draft.column(parts, FieldKind.TEXT)))
    is_motor = draft.proposition(Compare(Comparison.EQUAL, name, draft.constant(0.0)))
    some = draft.proposition(Quantified(Quantifier.ANY, is_motor))
    bench = Bench(draft)
    bench.send(0, c0=[-1.0, 1.0])
    assert bench.proposition(some) is F
    bench.send(0, c0=[-1.0, 0.0])
    assert bench.proposition(some) is T


@pytest.mark.parametrize(
    ("distances", "speeds", "seen"),
    [
        ([1.0, NAN], [1.0, 1.0], [T, U, None, None]),
        ([NAN, 9.0], [1.0, 1.0], [U, F, None, None]),
        ([NAN, 9.0], [-1.0, 1.0], [F, F, 0.0, None]),  # it recedes, wherever it is
        ([1.0, 9.0], [NAN, 1.0], [U, F, None, 1.0]),
    ],
)
def test_s52_a_field_that_is_unknown_leaves_the_others(
    distances: list[float], speeds: list[float], seen: list[object]
) -> None:
    objects = Objects()
    bench = objects.bench()
    objects.send(bench, distances, speeds)
    assert objects.seen(bench) == seen


def test_s53_a_list_without_elements_is_known() -> None:
    objects = Objects(timeout_ns=SECOND)
    bench = objects.bench()
    bench.advance(0)
    assert objects.seen(bench) == [L, L, None, None]
    objects.send(bench, [], [])
    assert objects.seen(bench) == [F, T, 0.0, INFINITY]
    assert bench.signal(objects.farthest) == -INFINITY
    bench.advance(1)
    assert objects.seen(bench) == [L, L, None, None]


def test_s53_nothing_is_near_and_nothing_is_fast_in_a_list_without_elements() -> None:
    objects = Objects(timeout_ns=SECOND)
    draft = objects.draft
    near = draft.proposition(Compare(Comparison.LESS, objects.nearest, draft.constant(1.0)))
    far = draft.above(objects.farthest, 1.0)
    bench = objects.bench()
    objects.send(bench, [], [])
    assert (bench.proposition(near), bench.proposition(far)) == (F, F)


@pytest.mark.parametrize("folding", Folding)
def test_s54_arithmetic_with_the_least_of_nothing_is_unknown_and_not_stale(
    folding: Folding,
) -> None:
    objects = Objects(timeout_ns=SECOND)
    draft = objects.draft
    folded = draft.signal(Fold(folding, objects.distance))
    nearer = draft.above(draft.apply(Function.SUBTRACT, folded, draft.constant(0.5)), 0.0)
    before = draft.signal(Sampled(Sampling.PREVIOUS, folded))
    size = draft.above(draft.apply(Function.ABSOLUTE, before), 0.0)
    bench = objects.bench()
    objects.send(bench, [], [])
    assert (bench.proposition(nearer), bench.proposition(size)) == (U, U)
    objects.send(bench, [2.0], [0.0], at_ns=1)
    assert (bench.proposition(nearer), bench.proposition(size)) == (T, U)
    objects.send(bench, [NAN], [0.0], at_ns=2)
    assert (bench.proposition(nearer), bench.proposition(size)) == (L, T)


def test_s54_a_list_that_is_not_known_is_stale_where_its_input_has_a_timeout() -> None:
    objects = Objects(timeout_ns=SECOND)
    draft = objects.draft
    near = draft.proposition(Compare(Comparison.LESS, objects.nearest, draft.constant(1.0)))
    many = draft.above(objects.count, 1.0)
    bench = objects.bench()
    objects.send(bench, [5.0] * 4, [0.0] * 4)
    assert objects.seen(bench)[:2] == [L, L]
    assert (bench.proposition(near), bench.proposition(many)) == (L, L)


def test_results_over_two_lists_do_not_meet() -> None:
    draft = Draft()
    used = draft.input(draft.channel())
    one, other = (draft.signal(Element(draft.column(draft.list_of(used, 2)))) for _ in range(2))
    draft.proposition(Compare(Comparison.LESS, one, other))
    with pytest.raises(MalformedMachine, match="elements of 2 arrays meet"):
        verify(draft.machine())
