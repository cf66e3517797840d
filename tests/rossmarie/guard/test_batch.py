"""Guards in a row: shapes, instants, restarts; the same in C and in Python."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rossmarie.guard import Guard, MappingError
from support.c_compiler import needs_c
from support.policy_rules import guard_of

SEEN = np.array([[0.0, 0.0, 2.0, 2.0], [1.5, 0.0, 2.0, 2.0], [0.0, 0.0, 2.0, 0.3]])
WANTED = np.array([[0.8, 0.1]] * 3)


@pytest.fixture(params=[pytest.param("native", marks=needs_c), "python"])
def guard(request: pytest.FixtureRequest, tmp_path: Path) -> Guard:
    return guard_of(request.param, tmp_path)


def test_each_row_has_a_guard_of_its_own(guard: Guard) -> None:
    batch = guard.batch(3)
    found = batch.step(0, SEEN, WANTED)
    assert found.actions.tolist() == [[0.8, 0.1], [0.2, 0.1], [-0.1, 0.0]]
    assert found.changed.tolist() == [False, True, True]
    active = [
        [rule for rule, is_on in zip(batch.rules, row, strict=True) if is_on]
        for row in found.active
    ]
    assert active == [[], ["fast"], ["near"]]
    assert WANTED.tolist() == [[0.8, 0.1]] * 3
    assert len(batch) == 3


def test_some_rows_begin_anew(guard: Guard) -> None:
    batch = guard.batch(3)
    held = SEEN + np.array([0, 1, 0, 0])
    assert batch.step(5, held, WANTED).active[:, 3].all()
    batch.restart(np.array([True, False, True]))
    found = batch.step(np.array([0, 6, 0]), SEEN, WANTED)
    assert found.active[:, 3].tolist() == [False, True, False]
    batch.restart()
    assert not batch.step(0, SEEN, WANTED).active[:, 3].any()


def test_an_observation_and_an_action_may_come_one_after_the_other(guard: Guard) -> None:
    whole, batch = guard.batch(3), guard.batch(3)
    far = np.array([[0.0, 0.0, 2.0, 6.0]] * 3)  # a command that is published once
    for at_ns, seen in ((0, SEEN), (7, SEEN), (8, far)):
        decided = whole.step(at_ns, seen, WANTED)
        assert (batch.observe(at_ns, seen) == decided.active).all()
        found = batch.decide(WANTED)
        assert found.actions.tolist() == decided.actions.tolist()
        assert found.changed.tolist() == decided.changed.tolist()
        assert (found.active == decided.active).all()


def test_rows_that_are_not_marked_stay_as_they_are(guard: Guard) -> None:
    batch = guard.batch(3)
    batch.observe(0, SEEN)
    first = np.array([True, False, False])
    assert batch.observe(5, SEEN + np.array([0, 1, 0, 0]), first)[:, 3].tolist() == [
        True,
        False,
        False,
    ]
    batch.restart(first)
    assert batch.observe(0, SEEN, first)[:, 3].tolist() == [False, False, False]
    found = batch.decide(WANTED, np.array([False, True, False]))
    assert found.changed.tolist() == [False, True, False]
    assert found.actions.tolist() == [[0.8, 0.1], [0.2, 0.1], [0.8, 0.1]]


def test_actions_that_would_pass_are_reported_and_nothing_happens(guard: Guard) -> None:
    batch = guard.batch(3)
    batch.observe(0, SEEN)
    some = np.array([[0.8, 0.1], [0.2, 0.1], [-0.1, 0.0], [np.nan, 0.0]])
    for _ in range(2):
        assert batch.allows(some).tolist() == [
            [True, True, True, False],
            [False, True, True, False],
            [False, False, True, False],
        ]
    assert batch.decide(WANTED).actions.tolist() == [[0.8, 0.1], [0.2, 0.1], [-0.1, 0.0]]


def test_nothing_is_decided_before_an_observation(guard: Guard) -> None:
    batch = guard.batch(3)
    with pytest.raises(ValueError, match="there is no observation yet"):
        batch.decide(WANTED)
    batch.observe(0, SEEN)
    batch.restart(np.array([False, True, False]))
    for call in (batch.decide, batch.allows):
        with pytest.raises(ValueError, match="row 1 has no observation yet"):
            call(WANTED)


def test_floats_of_32_bits_stay_so(guard: Guard) -> None:
    found = guard.batch(3).step(0, SEEN.astype(np.float32), WANTED.astype(np.float32)).actions
    assert found.dtype == np.float32
    assert 0.1999999 < found[1, 0] <= np.float64(0.2)
    assert found[0].tolist() == WANTED[0].astype(np.float32).tolist()


REFUSED: list[tuple[Any, Any, Any, type[Exception], str]] = [
    (1, SEEN[:2], WANTED, MappingError, r"observations have the shape \(2, 4\), not \(3, ...\)"),
    (1, SEEN, WANTED[0], MappingError, r"actions have the shape \(2,\)"),
    (1, SEEN[:, :3], WANTED, MappingError, "observations have 3 numbers, but had 4 at first"),
    (1, SEEN.astype(int), WANTED, MappingError, "observations hold int64"),
    (1, SEEN.tolist(), WANTED, TypeError, "observations are a list"),
    (1.0, SEEN, WANTED, MappingError, "instants are one int64"),
    (np.zeros(2, np.int64), SEEN, WANTED, MappingError, "instants are one int64"),
    (2**62, SEEN, WANTED, ValueError, "out of range"),
    (np.array([2, 0, 2]), SEEN, WANTED, ValueError, "time goes back to 0 ns in row 1"),
]


def test_what_does_not_fit_is_refused_and_changes_nothing(guard: Guard) -> None:
    batch = guard.batch(3)
    batch.step(1, SEEN, WANTED)
    for times, seen, wanted, kind, words in REFUSED:
        with pytest.raises(kind, match=words):
            batch.step(times, seen, wanted)
    assert batch.step(1, SEEN, WANTED).active.any(axis=1).tolist() == [False, True, True]
    with pytest.raises(MappingError, match="a mask needs the type bool"):
        batch.restart(np.zeros(2, np.bool_))
    with pytest.raises(ValueError, match="at least one guard, not 0"):
        guard.batch(0)


def test_each_row_has_margins_of_its_own(guard: Guard) -> None:
    batch = guard.batch(3)
    assert np.isnan(batch.margin).all()
    batch.observe(0, SEEN, np.array([True, True, False]))
    np.testing.assert_allclose(batch.margin[:2], [[3.6, 1500.0], [-1.8, 1500.0]])
    assert np.isnan(batch.margin[2]).all()
    assert batch.rules_with_margin == ("fast", "near")
    batch.step(0, SEEN, WANTED)
    np.testing.assert_allclose(batch.margin[2], [3.6, -200.0])


def test_a_batch_refuses_to_be_copied(guard: Guard) -> None:
    batch = guard.batch(2)
    for copied in (copy.copy, copy.deepcopy, pickle.dumps):
        with pytest.raises(TypeError, match=r"make another with `guard.batch\(n\)`"):
            copied(batch)
