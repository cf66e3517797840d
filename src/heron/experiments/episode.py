"""The common parts of all episodes."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from heron.guard import Guard


def seeded(names: Sequence[str], seed: int) -> dict[str, np.random.Generator]:
    """A generator for each thing that is left to chance: none of them knows of the others."""
    sources = np.random.SeedSequence(seed).spawn(len(names))
    return dict(zip(names, map(np.random.default_rng, sources), strict=True))


def acting(guard: Guard | None) -> Callable[[], bool]:
    """A function that says whether a guard, if there is one, does anything at the moment."""
    return lambda: guard is not None and guard.is_acting


def reported_by(guard: Guard | None) -> tuple[tuple[float, str], ...]:
    """The verdicts in words, with their instants (s)."""
    if guard is None:
        return ()
    return tuple((at_ns * 1e-9, words) for at_ns, words in guard.reported)
