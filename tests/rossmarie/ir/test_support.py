"""The support of signals, propositions and rules."""

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
    count = draft.signal(ir.Count(draft.proposition(ir.Not(above))))
    support = ir.supports(draft.machine()).signals[count]
    assert (support.arrays, support.folds) == (frozenset({0}), frozenset({count}))


def test_an_age_rests_on_its_input_alone() -> None:
    draft = Draft()
    draft.read()
    held = draft.proposition(ir.Held(draft.proposition(ir.AgeReaches(0, 1)), 1))
    support = ir.supports(draft.machine()).propositions[held]
    assert support == ir.Support(inputs=frozenset({0}), channels=frozenset({0}))


def test_element_arrays() -> None:
    draft = Draft()
    element, x = draft.elements(), draft.read()
    off = draft.apply(ir.Function.ABSOLUTE, element)
    far = draft.proposition(ir.Not(draft.above(off, 1.0)))
    some = draft.proposition(ir.Quantified(ir.Quantifier.ANY, far))
    arrays = ir.element_arrays(draft.machine())
    assert (arrays.signals[element], arrays.signals[off], arrays.propositions[far]) == (0, 0, 0)
    assert (arrays.signals[x], arrays.propositions[some]) == (None, None)


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
    some = draft.proposition(ir.Quantified(ir.Quantifier.ANY, on_elements))
    both = draft.proposition(ir.And((above, some)), name="entity.both")
    held = draft.proposition(ir.Held(both, 5))
    condition = draft.proposition(ir.Not(held))
    machine = draft.machine()
    # Neither what is said of elements, nor an unnamed negation, nor a constant.
    assert ir.rule_terms(machine, condition) == (above, some, both, held)
    assert ir.leaf_propositions(machine, condition) == (above, some)
    assert ir.rule_signals(machine, condition) == (x,)
    assert ir.reachable_propositions(machine, condition) == (above, some, both, held, condition)
