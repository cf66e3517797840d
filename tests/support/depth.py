"""The depth of random tests, in each run and in `make deep`."""

from __future__ import annotations

from collections.abc import Iterable

import pytest
from _pytest.mark import ParameterSet
from hypothesis import Phase, settings

_MANY = 100


def examples(factor: float) -> int:
    """A number of examples: `factor` times as many as the profile has."""
    return round(factor * settings().max_examples)


def is_deep() -> bool:
    """Say whether `make deep` runs the tests."""
    return settings().max_examples > _MANY


def phases_of_compiled() -> tuple[Phase, ...]:
    """The phases for examples that are compiled: shrinking one compiles hundreds of others, so
    only `make deep` does that.
    """
    return tuple(Phase) if is_deep() else (Phase.explicit, Phase.reuse, Phase.generate)


def deep(cases: Iterable[object]) -> list[ParameterSet]:
    """Parameters whose tests only `make deep` runs; a tuple is the parameters of one test."""
    found = []
    for case in cases:
        values = case if isinstance(case, tuple) else (case,)
        found.append(pytest.param(*values, marks=pytest.mark.deep))
    return found
