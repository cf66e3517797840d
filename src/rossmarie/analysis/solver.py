"""Queries to z3 with a limit: the answer is a model, a proof that there is none, or neither."""

from __future__ import annotations

import enum
from collections.abc import Sequence
from dataclasses import dataclass

import z3

EFFORT = 3_000_000
"""The greatest effort for a query, in steps of the solver. Unlike time, steps are the same on every
machine.
"""

LIMIT_MS = 20_000
"""The time limit of a query in milliseconds, whatever its number of steps."""


_BY_CTRL_C = "interrupted from keyboard"


class Satisfiability(enum.Enum):
    """The outcome of a query."""

    POSSIBLE = "possible"
    IMPOSSIBLE = "impossible"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Answer:
    """The outcome of a query. If the outcome is POSSIBLE, it contains a model."""

    outcome: Satisfiability
    model: z3.ModelRef | None = None


_OUTCOMES = {"sat": Satisfiability.POSSIBLE, "unsat": Satisfiability.IMPOSSIBLE}


class Solver:
    """Facts that stay, and predicates that are queried together with the facts, one after
    another.
    """

    def __init__(self, facts: Sequence[z3.BoolRef]) -> None:
        self._solver = z3.Solver()
        self._solver.set(timeout=LIMIT_MS, rlimit=EFFORT)
        self._solver.add(facts)

    def ask(self, *predicates: z3.BoolRef) -> Answer:
        """Query whether the facts and all the predicates can be true together."""
        self._solver.push()
        self._solver.add(predicates)
        outcome = _OUTCOMES.get(str(check(self._solver)), Satisfiability.UNDECIDED)
        model = self._solver.model() if outcome is Satisfiability.POSSIBLE else None
        self._solver.pop()
        return Answer(outcome, model)


def check(solver: z3.Solver) -> z3.CheckSatResult:
    """Query z3. z3 handles Ctrl-C itself and then returns "undecided". This function raises
    `KeyboardInterrupt` instead, so that Ctrl-C ends the run.
    """
    found = solver.check()
    if found == z3.unknown and solver.reason_unknown() == _BY_CTRL_C:
        raise KeyboardInterrupt
    return found


def ask(facts: Sequence[z3.BoolRef], *predicates: z3.BoolRef) -> Answer:
    """Ask a single query."""
    return Solver(facts).ask(*predicates)
