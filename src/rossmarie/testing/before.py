"""Values that precede others, so that each `since` has its required value."""

from __future__ import annotations

import z3

from rossmarie.analysis.terms import constant
from rossmarie.testing.solve import RuleFormulas
from rossmarie.testing.variables import Values


def wanted_before(world: RuleFormulas, values: Values) -> list[z3.BoolRef]:
    """The formulas that must be true before these values; none if the past does not matter."""
    wanted = []
    for variable, held, begun in world.remembering():
        if variable in values and _is_so(world, z3.And(held, z3.Not(begun)), values):
            wanted.append(begun if values[variable] else z3.Not(z3.Or(held, begun)))
    return wanted


def _is_so(world: RuleFormulas, formula: z3.BoolRef, values: Values) -> bool:
    pairs = [(world.variables[each], constant(value)) for each, value in values.items()]
    return z3.is_true(z3.simplify(z3.substitute(formula, *pairs)))
