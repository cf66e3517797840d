"""Expectations of runs that are planned with knowledge from earlier runs, compared with the same
runs without it.

Section 5.3 of the thesis requires fewer errors, safety and efficiency. A plan counts one second per
step, independent of its length, plus the time lost to rules. So learning can save activations of
rules and cost time.
"""

from __future__ import annotations

from collections.abc import Iterator

from heron.evaluation.expectation import ExpectationVerdict, ResultExpectation, between, greater
from heron.evaluation.sample import Sample
from heron.evaluation.tree_expectations import alone, touches_nothing
from heron.experiments.experiment import DURATION
from heron.experiments.table import ACTIVATIONS
from heron.variants import ExperimentArm, Trouble

_FIRST, _SECOND = ExperimentArm.TREES, ExperimentArm.LEARNED


def expectations_of_learning(sample: Sample) -> Iterator[ResultExpectation]:
    """All expectations of a variant."""
    yield from (alone(sample, arm) for arm in sample.arms)
    yield touches_nothing(sample)
    if sample.variant == Trouble.NONE.value:
        yield _the_same(sample)
        return
    yield _fewer_activations(sample)
    yield _no_activation(sample)
    if sample.variant == Trouble.LASTING.value:
        yield _sooner(sample)
    else:
        yield _later(sample)
    yield _later_where_nothing_was(sample)


def _fewer_activations(sample: Sample) -> ResultExpectation:
    compared = sample.compared(ACTIVATIONS.name, _FIRST, _SECOND)
    first, second = (sum(sample.values(arm, ACTIVATIONS.name)) for arm in (_FIRST, _SECOND))
    return ResultExpectation(
        "fewer activations",
        "after learning, rules become active less often",
        f"{first:.0f} times without learning, {second:.0f} times after learning, "
        f"p = {compared.chance:.2g}",
        greater(first - second, compared.chance),
    )


def _no_activation(sample: Sample) -> ResultExpectation:
    values = sample.values(_SECOND, ACTIVATIONS.name)
    quiet = sum(value == 0 for value in values)
    return ResultExpectation(
        "no activation",
        "after learning, no rule becomes active in any episode",
        f"in {quiet} of {len(values)}",
        ExpectationVerdict.HOLDS if quiet == len(values) else ExpectationVerdict.FAILS,
    )


def _sooner(sample: Sample) -> ResultExpectation:
    return _slower(sample, _FIRST, "sooner", "after learning, the base arrives sooner")


def _later(sample: Sample) -> ResultExpectation:
    expected = (
        "after learning, the base arrives later: the plan counts the longer path as one more step, "
        "but that path takes more time than the rules would cost"
    )
    return _slower(sample, _SECOND, "later", expected)


def _slower(sample: Sample, arm: ExperimentArm, key: str, expected: str) -> ResultExpectation:
    """Expect that an arm takes longer than the other one."""
    (other,) = (each for each in sample.arms if each is not arm)
    compared = sample.compared(DURATION.name, arm, other)
    return ResultExpectation(
        key,
        expected,
        f"by {between(compared.difference, DURATION.digits)} s, p = {compared.chance:.2g}",
        greater(compared.difference.value, compared.chance),
    )


def _later_where_nothing_was(sample: Sample) -> ResultExpectation:
    """The cost of a plan that is better only in most runs."""
    first, second = (sample.by_seed(arm, DURATION.name) for arm in (_FIRST, _SECOND))
    active = sample.by_seed(_FIRST, ACTIVATIONS.name)
    free = [seed for seed in first.keys() & second.keys() if active.get(seed) == 0]
    later = sum(second[seed] > first[seed] for seed in free)
    return ResultExpectation(
        "later where free",
        "in each run without an obstacle, the base arrives later after learning",
        f"in {later} of {len(free)}",
        ExpectationVerdict.HOLDS if free and later == len(free) else ExpectationVerdict.FAILS,
    )


def _the_same(sample: Sample) -> ResultExpectation:
    first, second = (sample.by_seed(arm, DURATION.name) for arm in (_FIRST, _SECOND))
    same = sum(second.get(seed) == time for seed, time in first.items())
    return ResultExpectation(
        "the same",
        "if no rule became active in earlier runs, learning changes nothing: the base arrives at "
        "the same instant in every episode",
        f"in {same} of {len(first)}",
        ExpectationVerdict.HOLDS if same == len(first) else ExpectationVerdict.FAILS,
    )
