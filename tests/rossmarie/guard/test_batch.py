"""Guards in a row: shapes, instants, restarts; the same in C and in Python."""

from __future__ import annotations

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


def test_floats_of_32_bits_stay_so(guard: Guard) -> None:
    found = guard.batch(3).step(0, SEEN.astype(np.float32), WANTED.astype(np.float32)).actions
    assert found.dtype == np.float32
    assert 0.1999999 < found[1, 0] <= np.float64(0.2)
    assert found[0].tolist() == WANTED[0].astype(np.float32).tolist()


REFUSED: list[tuple[Any, Any, Any, type[Exception], str]] = [
    (1, SEEN[:2], WANTED, MappingError, r"observations have the shape \(2, 4\), not \(3, ...\)"),
    (1, SEEN, WANTED[0], MappingError, r"actions have the shape \(2,\)"),
    (1, SEEN[:, :3], WANTED, MappingError, r"have \(3, 2\) numbers, but had \(4, 2\)"),
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
    with pytest.raises(MappingError, match="a mask is bool"):
        batch.restart(np.zeros(2, np.bool_))
    with pytest.raises(ValueError, match="at least one guard, not 0"):
        guard.batch(0)
