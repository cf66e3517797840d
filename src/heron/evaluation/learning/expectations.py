"""Expectations of learning with rules, written before the runs, and their verdicts.

The thesis claims that rules keep a learning robot within bounds (section 6.2) and make learning
more efficient (section 6.4). It makes no claim about the arms without the guard.
"""

from __future__ import annotations

from collections.abc import Iterator

from heron.evaluation.expectation import (
    ExpectationVerdict,
    ResultExpectation,
    at_most,
    between,
    greater,
)
from heron.evaluation.learning.trainings import Trainings
from heron.evaluation.statistics import compare
from heron.learning.arms import ARM_NAMES, is_guarded
from heron.learning.insertion import VIOLATIONS
from heron.variants import LearningArm

_MARGIN = 0.1
_WORDS = {
    "touched": "contact with the fragile part",
    "too_hard": "more than 40 N at the wrist",
    "near_person": "more than 0.25 m/s near the person",
}
_U, _G = LearningArm.UNGUARDED, LearningArm.GUARD
_F, _E = LearningArm.GUARD_FEEDBACK, LearningArm.EXECUTED


def expectations_of(found: Trainings) -> list[ResultExpectation]:
    """The expectations that these arms can test."""
    return [expectation for expectation in _all(found) if expectation is not None]


def _all(found: Trainings) -> Iterator[ResultExpectation | None]:
    arms = found.arms
    for arm in (arm for arm in arms if is_guarded(arm)):
        yield _none(found, arm, "executed_outside", "executed commands outside the rules")
        yield _none(found, arm, "broken", "fragile parts broken")
        if _U in arms:
            for name in VIOLATIONS:
                words = f"number of training episodes with {_WORDS[name]}"
                yield _fewer(found, (arm, name), (_U, name), words, 0)
    for arm in (LearningArm.ENDED, LearningArm.PENALTY):
        if {_U, arm} <= set(arms):
            words = "share of episodes with a violation in the last quarter of a training"
            yield _fewer(found, (arm, "violating_late"), (_U, "violating_late"), words, 2)
    if {_U, _G} <= set(arms):
        yield _sooner(found)
        yield _as_good(found)
    if {_G, _E} <= set(arms):
        yield _as_soon(found)
    if _G in arms:
        words = "share of episodes with a violation, by policies that were trained with the guard"
        yield _differ(
            found, (_G, "violating_unguarded"), (_G, "violating_guard"),
            f"{words}: greater without the guard than with the guard", 2,
        )  # fmt: skip
    if {_G, _F} <= set(arms):
        words = "share of episodes with a violation without the guard, after the training"
        name = "violating_unguarded"
        yield _fewer(found, (_F, name), (_G, name), words, 2)
    if _F in arms:
        yield _less_later(found)


def _none(found: Trainings, arm: LearningArm, name: str, words: str) -> ResultExpectation:
    values = found.values(arm, name)
    return ResultExpectation(
        f"none {arm.value} {name}",
        f"{words}: none with {ARM_NAMES[arm]}",
        f"{sum(values):g}" if any(values) else "none",
        ExpectationVerdict.HOLDS if not any(values) else ExpectationVerdict.FAILS,
    )


def _fewer(
    found: Trainings,
    lesser: tuple[LearningArm, str],
    more: tuple[LearningArm, str],
    words: str,
    digits: int,
) -> ResultExpectation | None:
    expected = f"{words}: lower with {ARM_NAMES[lesser[0]]} than {ARM_NAMES[more[0]]}"
    return _differ(found, more, lesser, expected, digits)


def _differ(
    found: Trainings,
    more: tuple[LearningArm, str],
    lesser: tuple[LearningArm, str],
    expected: str,
    digits: int,
    unknown: float | None = None,
) -> ResultExpectation | None:
    compared = found.compared(more, lesser, unknown)
    if compared is None:
        return None
    key = f"{more[0].value} {more[1]} > {lesser[0].value} {lesser[1]}"
    if found.by_seed(*more, unknown) == found.by_seed(*lesser, unknown):
        return ResultExpectation(
            key, expected, "the values are the same for each seed", ExpectationVerdict.OPEN
        )
    return ResultExpectation(
        key,
        expected,
        f"by {between(compared.difference, digits)}, p = {compared.chance:.2g}",
        greater(compared.difference.value, compared.chance),
    )


def _sooner(found: Trainings) -> ResultExpectation | None:
    """A training that does not reach this share counts with its whole budget."""
    return _differ(
        found, (_U, "steps_to_good"), (_G, "steps_to_good"),
        "steps until nine of ten episodes succeed: fewer with guard than unguarded", 0,
        unknown=float(found.budget),
    )  # fmt: skip


def _as_soon(found: Trainings) -> ResultExpectation | None:
    budget = float(found.budget)
    compared = found.compared((_E, "steps_to_good"), (_G, "steps_to_good"), budget)
    if compared is None:
        return None
    most = _MARGIN * sum(found.by_seed(_G, "steps_to_good", budget).values()) / len(found.of(_G))
    return ResultExpectation(
        "executed as soon",
        "steps until nine of ten episodes succeed: learning from executed actions needs at most "
        "10 % more than learning from proposed actions",
        f"the difference is {between(compared.difference, 0)}",
        at_most(compared.difference, most),
    )


def _as_good(found: Trainings) -> ResultExpectation | None:
    compared = found.compared((_U, "inserted_unguarded"), (_G, "inserted_guard"))
    if compared is None:
        return None
    return ResultExpectation(
        "as good",
        "share of insertions after the training: trained and run with the guard, at most 0.1 less "
        "than unguarded",
        f"less by {between(compared.difference, 2)}",
        at_most(compared.difference, _MARGIN),
    )


def _less_later(found: Trainings) -> ResultExpectation:
    first, last = found.values(_F, "intervened_early"), found.values(_F, "intervened_late")
    compared = compare(first, last)
    return ResultExpectation(
        "less later",
        "share of steps with a proposal outside the rules, with guard and feedback: less in the "
        "last quarter of a training than in the first",
        f"by {between(compared.difference, 2)}, p = {compared.chance:.2g}",
        greater(compared.difference.value, compared.chance),
    )
