"""What signals, truths and rules rest on."""

import pytest

from rossmarie import ir
from support.drafts import Draft


def test_support_goes_through_functions_samples_and_folds() -> None:
    draft = Draft()
    x, element = draft.read(), draft.elements()
    least = draft.signal(ir.Fold(ir.Folding.MINIMUM, element))
    rate = draft.signal(ir.Sampled(ir.Sampling.RATE, x))
    total = draft.apply(ir.Function.ADD, rate, least)
    previous = draft.signal(ir.Sampled(ir.Sampling.PREVIOUS, total))
    support = ir.supports(draft.machine()).signals[previous]
    assert support == ir.Support(
        slots=frozenset({0}),
        arrays=frozenset({0}),
        folds=frozenset({least}),
        samples=frozenset({rate, previous}),
        inputs=frozenset({0, 1}),
        channels=frozenset({0, 1}),
    )


def test_a_count_rests_on_the_array_of_what_it_counts() -> None:
    draft = Draft()
    above = draft.above(draft.elements(), 0.0)
    count = draft.signal(ir.Count(draft.truth(ir.Not(above))))
    support = ir.supports(draft.machine()).signals[count]
    assert (support.arrays, support.folds) == (frozenset({0}), frozenset({count}))


def test_an_age_rests_on_its_input_alone() -> None:
    draft = Draft()
    draft.read()
    held = draft.truth(ir.Held(draft.truth(ir.AgeReaches(0, 1)), 1))
    support = ir.supports(draft.machine()).truths[held]
    assert support == ir.Support(inputs=frozenset({0}), channels=frozenset({0}))


def test_element_arrays() -> None:
    draft = Draft()
    element, x = draft.elements(), draft.read()
    off = draft.apply(ir.Function.ABSOLUTE, element)
    far = draft.truth(ir.Not(draft.above(off, 1.0)))
    some = draft.truth(ir.Quantified(ir.Quantifier.ANY, far))
    arrays = ir.element_arrays(draft.machine())
    assert (arrays.signals[element], arrays.signals[off], arrays.truths[far]) == (0, 0, 0)
    assert (arrays.signals[x], arrays.truths[some]) == (None, None)


def test_elements_of_two_arrays_have_no_one_array() -> None:
    draft = Draft()
    draft.apply(ir.Function.ADD, draft.elements(), draft.elements())
    with pytest.raises(ValueError, match="elements of 2 arrays meet"):
        ir.element_arrays(draft.machine())


def test_what_a_rule_carries_in_its_verdicts() -> None:
    draft = Draft()
    x, element = draft.read(), draft.elements()
    above = draft.above(x, 0.0)
    on_elements = draft.above(element, 1.0)
    some = draft.truth(ir.Quantified(ir.Quantifier.ANY, on_elements))
    both = draft.truth(ir.And((above, some)), name="entity.both")
    held = draft.truth(ir.Held(both, 5))
    condition = draft.truth(ir.Not(held))
    machine = draft.machine()
    # Neither what is said of elements, nor an unnamed negation, nor a constant.
    assert ir.rule_terms(machine, condition) == (above, some, both, held)
    assert ir.leaf_truths(machine, condition) == (above, some)
    assert ir.rule_signals(machine, condition) == (x,)
    assert ir.reachable_truths(machine, condition) == (above, some, both, held, condition)
