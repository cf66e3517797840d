"""Numbers beside elements: rules S74 and S75 of docs/explanation/semantics.md."""

import math

import pytest

from rossmarie.ir import (
    ChannelValues,
    Compare,
    Comparison,
    Count,
    Element,
    Fold,
    Folding,
    Function,
    MalformedMachine,
    Or,
    Quantified,
    Quantifier,
    Sampled,
    Sampling,
    TruthValue,
    verify,
)
from support.bench import Bench, reported
from support.drafts import SECOND, Draft
from support.machines import NAN

F, T, U, L = TruthValue


class Near:
    """The elements of an array on channel 0, and a number on channel 1: is any element below twice
    that, how many are, and the least of all differences.
    """

    def __init__(self, timeout_ns: int | None = None, beside_ns: int | None = None) -> None:
        self.draft = draft = Draft()
        self.element = draft.elements(timeout_ns)
        self.beside = draft.read(beside_ns)
        twice = draft.apply(Function.MULTIPLY, self.beside, draft.constant(2.0))
        self.below = draft.proposition(Compare(Comparison.LESS, self.element, twice))
        self.any = draft.proposition(Quantified(Quantifier.ANY, self.below))
        self.count = draft.signal(Count(self.below))
        apart = draft.apply(Function.SUBTRACT, self.element, self.beside)
        self.least = draft.signal(Fold(Folding.MINIMUM, apart))
        self.leaf = draft.above(self.least, 0.0)

    def seen(self, bench: Bench) -> tuple[TruthValue | None, float, float]:
        return bench.proposition(self.any), bench.signal(self.count), bench.signal(self.least)


def test_s74_all_messages_of_one_update_count() -> None:
    near = Near()
    bench = Bench(near.draft)
    bench.send(0, c0=[1.0, 3.0, 5.0], c1=2.0)
    assert near.seen(bench) == (T, 2.0, -1.0)
    bench.send(1, c0=[1.0, 3.0, 5.0])
    assert near.seen(bench) == (T, 2.0, -1.0)


def test_s74_a_number_that_changes_changes_nothing_until_elements_arrive() -> None:
    near = Near()
    bench = Bench(near.draft)
    bench.send(0, c0=[3.0], c1=1.0)
    bench.send(1, c1=5.0)
    assert near.seen(bench) == (F, 0.0, 2.0)
    bench.send(2, c0=[3.0])
    assert near.seen(bench) == (T, 1.0, -2.0)


def test_s74_samples_are_taken_when_elements_arrive() -> None:
    near = Near()
    rate = near.draft.signal(Sampled(Sampling.RATE, near.least))
    bench = Bench(near.draft)
    bench.send(0, c0=[3.0], c1=1.0)
    bench.send(1, c1=2.0)
    bench.send(2, c0=[3.0])
    assert bench.signal(rate) == -0.5


def test_s74_without_the_number_what_does_not_rest_on_it_is_known() -> None:
    near = Near()
    draft = near.draft
    touching = draft.proposition(Compare(Comparison.LESS, near.element, draft.constant(0.5)))
    either = draft.proposition(Or((near.below, touching)))
    close = draft.proposition(Quantified(Quantifier.ANY, either))
    bench = Bench(draft)
    bench.send(0, c0=[0.25, 3.0])
    assert bench.proposition(close) is T
    assert bench.proposition(near.any) is U
    assert math.isnan(bench.signal(near.count))


def test_s74_of_no_elements_nothing_is_beyond_a_number_that_is_not_known() -> None:
    draft = Draft()
    column = draft.column(draft.list_of(draft.input(draft.channel()), most=2))
    below = draft.proposition(Compare(Comparison.LESS, draft.signal(Element(column)), draft.read()))
    found = draft.proposition(Quantified(Quantifier.ANY, below))
    bench = Bench(draft)
    for elements, expected in (([], F), ([1.0], U)):
        bench.monitor.update(0, {0: ChannelValues(arrays={column: elements})})
        assert bench.proposition(found) is expected


def test_s74_results_are_forgotten_when_an_input_of_the_number_expires() -> None:
    near = Near(beside_ns=SECOND)
    bench = Bench(near.draft)
    bench.send(0, c0=[3.0], c1=1.0)
    bench.advance(1)
    assert bench.proposition(near.any) is L
    assert math.isnan(bench.signal(near.least))
    bench.send(2, c1=1.0)  # it is back, but the elements are gone
    assert bench.proposition(near.any) is L
    bench.send(3, c1=1.0)
    bench.send(3, c0=[3.0])
    assert near.seen(bench) == (F, 0.0, 2.0)


def test_s74_what_expires_at_the_instant_of_the_elements_is_not_known() -> None:
    near = Near(beside_ns=SECOND)
    bench = Bench(near.draft)
    bench.send(0, c0=[3.0], c1=1.0)
    bench.send(1, c0=[3.0])
    assert bench.proposition(near.any) is L
    assert math.isnan(bench.signal(near.count))


def test_s74_a_jump_in_time_leaves_results() -> None:
    near = Near()
    bench = Bench(near.draft)
    bench.send(5, c0=[3.0], c1=1.0)
    bench.advance(1)
    assert near.seen(bench) == (F, 0.0, 2.0)


@pytest.mark.parametrize("function", [Sampling.PREVIOUS, Sampling.RATE])
def test_s74_numbers_of_samples_stand_outside(function: Sampling) -> None:
    near = Near()
    before = near.draft.signal(Sampled(function, near.beside))
    below = near.draft.proposition(Compare(Comparison.LESS, near.element, before))
    near.draft.proposition(Quantified(Quantifier.ANY, below))
    with pytest.raises(MalformedMachine, match="neither elementwise nor of slots and constants"):
        verify(near.draft.machine())


def test_s74_results_over_elements_stand_outside() -> None:
    near = Near()
    beyond = near.draft.apply(Function.ADD, near.element, near.least)
    near.draft.signal(Fold(Folding.MAXIMUM, beyond))
    with pytest.raises(MalformedMachine, match="neither elementwise nor of slots and constants"):
        verify(near.draft.machine())


@pytest.mark.parametrize(
    ("timeout_ns", "beside_ns", "expected"),
    [(None, None, U), (SECOND, None, L), (None, SECOND, L)],
)
def test_s75_the_inputs_of_the_numbers_count(
    timeout_ns: int | None, beside_ns: int | None, expected: TruthValue
) -> None:
    near = Near(timeout_ns, beside_ns)
    bench = Bench(near.draft)
    bench.send(0, c0=[3.0], c1=NAN)
    assert bench.proposition(near.any) is expected
    assert bench.proposition(near.leaf) is expected


def test_s75_a_rule_is_active_without_the_number() -> None:
    near = Near(beside_ns=SECOND)
    near.draft.rule(near.any)
    bench = Bench(near.draft)
    assert len(reported(bench.send(0, c0=[3.0]))) == 1
    assert bench.monitor.active == (True,)


def test_s75_a_number_that_is_not_known_now_excuses_nothing() -> None:
    """A division by a result that is known is not unknown for lack of that result."""
    near = Near(timeout_ns=SECOND)
    draft = near.draft
    inverse = draft.apply(Function.DIVIDE, draft.constant(1.0), near.least)
    leaf = draft.above(inverse, 1.0)
    bench = Bench(draft)
    bench.send(0, c0=[1.0], c1=1.0)
    assert bench.proposition(leaf) is L
    bench.send(0.5, c1=NAN)
    assert bench.proposition(leaf) is L
