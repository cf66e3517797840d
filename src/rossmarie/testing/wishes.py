"""Wishes about values that a solver has found: each is granted if all that is demanded still holds.

The effort is counted in steps of the solver, so that the same values are found on any machine. Time
ends it only where single steps take long.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import z3

from rossmarie.analysis.solver import LIMIT_MS, check

EFFORT = 3_000_000
"""The steps that demands may cost. Wishes are cheaper; they are many."""

_EFFORT_OF_WISH = 100_000
_MOST_UNDECIDED = 4


@dataclass
class Patience:
    """The number of wishes about the same formulas that may still stay undecided. Then only those
    are granted that hold as it is.
    """

    left: int = _MOST_UNDECIDED


class Wishes:
    """A solver whose demands can be met, and values that meet them: those of `model`."""

    def __init__(
        self,
        demands: Sequence[z3.BoolRef],
        variables: Sequence[z3.ArithRef],
        patience: Patience,
    ) -> None:
        """Look for values of `variables`; `model` stays None where none are found."""
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
        """Demand a wish too, if it can be had; `about` is the only variable that it names."""
        assert self.model is not None, "there are values"
        if z3.is_true(self.model.eval(wish, model_completion=True)):
            self._solver.add(wish)
            return True
        ways: list[Sequence[z3.BoolRef]] = [()] if about is None else [self._others(about), ()]
        for others in ways:
            if self._patience.left > 0 and self._is_granted(wish, others):
                self._solver.add(wish)
                return True
        return False

    def _others(self, about: z3.ArithRef) -> Sequence[z3.BoolRef]:
        """All variables but one as they are, which is a much easier query."""
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
