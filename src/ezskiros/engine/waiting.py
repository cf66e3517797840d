"""Guards in front of primitives: a skill that a rule would stop waits before it starts."""

from __future__ import annotations

from collections.abc import Sequence

from ezskiros.engine.execution_context import Guard
from ezskiros.engine.plans import ChildStart


def reason_to_wait(guard: Guard, plans: Sequence[ChildStart]) -> str:
    """The reason why a skill waits; empty if it may start. A compound never waits: the primitives
    of its tree do.
    """
    if all(plan.is_compound for plan in plans):
        return ""
    return guard(plans[0].skill.name) or ""
