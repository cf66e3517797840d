"""Wishes about a solver's values. A wish is granted if all demands can still be met.

The effort is counted in steps of the solver, so that every machine finds the same values. The time
limit ends the search only if single steps take long.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import z3

from rossmarie.analysis.solver import LIMIT_MS, check

EFFORT = 3_000_000
"""The most steps for the demands. Wishes get fewer steps, because there are many of them."""

_EFFORT_OF_WISH = 100_000
_MOST_UNDECIDED = 4


@dataclass
class Patience:
    """The number of wishes about the same formulas that may still stay undecided. At zero, only
    wishes that the present values fulfil are granted.
    """

    left: int = _MOST_UNDECIDED


class Wishes:
    """A solver whose demands can be met. `model` contains values that meet them."""

    def __init__(
        self,
        demands: Sequence[z3.BoolRef],
        variables: Sequence[z3.ArithRef],
        patience: Patience,
    ) -> None:
        """Search for values of `variables`; `model` stays None if none are found."""
        self._solver = z3.Solver()
        self._solver.set(rlimit=EFFORT, timeout=LIMIT_MS)
        self._solver.add(*demands)
        self._variables = variables
        self._patience = patience
        self.model: z3.ModelRef | None = None
        if check(self._solver) == z3.sat:
            self.model = self._solver.model()
        self._solver.set(rlimit=_EFFORT_OF_WISH)

    def grant(self, wish: z3.BoolRef, about: z3.ArithRef | None = None) -> bool:
        """Add a wish to the demands if it can be met. `about` is the only variable in the wish.
        Returns whether the wish was granted.
        """
        assert self.model is not None, "there are values"
        if z3.is_true(self.model.eval(wish, model_completion=True)):
            self._solver.add(wish)
            return True
        alternatives: list[Sequence[z3.BoolRef]] = (
            [()] if about is None else [self._others(about), ()]
        )
        for others in alternatives:
            if self._patience.left > 0 and self._is_granted(wish, others):
                self._solver.add(wish)
                return True
        return False

    def _others(self, about: z3.ArithRef) -> Sequence[z3.BoolRef]:
        """All variables but one keep their values, which makes the query much easier."""
        assert self.model is not None, "there are values"
        others = (each for each in self._variables if not z3.eq(each, about))
        return [each == self.model.eval(each, model_completion=True) for each in others]

    def _is_granted(self, wish: z3.BoolRef, others: Sequence[z3.BoolRef]) -> bool:
        self._solver.push()
        self._solver.add(wish, *others)
        found = check(self._solver)
        if found == z3.sat:
            self.model = self._solver.model()
        self._solver.pop()
        self._patience.left -= found == z3.unknown
        return bool(found == z3.sat)
