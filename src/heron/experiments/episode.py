"""What all experiments tell of an episode."""

from __future__ import annotations

from heron.guard import Guard


def told_by(guard: Guard | None) -> tuple[tuple[float, str], ...]:
    """The verdicts in words, with their instants (s)."""
    if guard is None:
        return ()
    return tuple((verdict.at_ns * 1e-9, guard.explain(verdict)) for verdict in guard.verdicts)
