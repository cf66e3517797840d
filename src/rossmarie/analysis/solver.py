"""Asking z3, with a limit: an answer is a model, a proof that there is none, or neither."""

from __future__ import annotations

import enum
from collections.abc import Sequence
from dataclasses import dataclass

import z3

EFFORT = 3_000_000
"""The effort that a query may cost, in steps of the solver: the same everywhere, unlike time."""

LIMIT_MS = 20_000
"""After this, in milliseconds, a query is given up however few steps it took."""


_BY_CTRL_C = "interrupted from keyboard"


class Satisfiability(enum.Enum):
    """The outcome of a query."""

    POSSIBLE = "possible"
    IMPOSSIBLE = "impossible"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Answer:
    """The outcome, with a model where it is POSSIBLE."""

    outcome: Satisfiability
    model: z3.ModelRef | None = None


_OUTCOMES = {"sat": Satisfiability.POSSIBLE, "unsat": Satisfiability.IMPOSSIBLE}


class Solver:
    """Facts that stay, and predicates that are asked together with them, one after the other."""

    def __init__(self, facts: Sequence[z3.BoolRef]) -> None:
        self._solver = z3.Solver()
        self._solver.set(timeout=LIMIT_MS, rlimit=EFFORT)
        self._solver.add(facts)

    def ask(self, *predicates: z3.BoolRef) -> Answer:
        """Ask whether the predicates can be so, all of them."""
        self._solver.push()
        self._solver.add(predicates)
        outcome = _OUTCOMES.get(str(check(self._solver)), Satisfiability.UNDECIDED)
        model = self._solver.model() if outcome is Satisfiability.POSSIBLE else None
        self._solver.pop()
        return Answer(outcome, model)


def check(solver: z3.Solver) -> z3.CheckSatResult:
    """Ask z3. While it works it takes Ctrl-C for itself, and calls that undecided: here it ends the
    run as everywhere.
    """
    found = solver.check()
    if found == z3.unknown and solver.reason_unknown() == _BY_CTRL_C:
        raise KeyboardInterrupt
    return found


def ask(facts: Sequence[z3.BoolRef], *predicates: z3.BoolRef) -> Answer:
    """A single query."""
    return Solver(facts).ask(*predicates)
