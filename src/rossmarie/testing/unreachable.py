"""The known reasons why goals cannot be reached.

z3 proves them in a world that allows more than is possible (`World.is_free`), so "no values" is
certain. The proofs hold for doubles and for reals, since only signs and extremes are computed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import z3

from rossmarie import ir
from rossmarie.analysis.terms import constant
from rossmarie.testing.goals import Aspect, TraceGoal, atoms, edges
from rossmarie.testing.sides import is_apart
from rossmarie.testing.solve import RuleFormulas

NO_VALUES = "no values make the rule hang on it"
STALE_ONLY = "only a stale input ends it sooner"


def unreachable(machine: ir.Machine, missing: Iterable[TraceGoal]) -> Mapping[TraceGoal, str]:
    """The reasons, for those goals that have a known reason."""
    return dict(_reasons(machine, missing))


def _reasons(machine: ir.Machine, missing: Iterable[TraceGoal]) -> Iterator[tuple[TraceGoal, str]]:
    worlds: dict[int, RuleFormulas] = {}
    for goal in missing:
        if goal.decision < 0:
            continue
        if goal.aspect is Aspect.UNDER and _ends_late(machine, goal.subject):
            yield goal, STALE_ONLY
            continue
        decided = goal.decision
        if decided not in worlds:
            worlds[decided] = RuleFormulas(machine, atoms(machine, decided), is_free=True)
        if worlds[decided].is_impossible(_wanted(worlds[decided], goal)):
            yield goal, NO_VALUES


def _ends_late(machine: ir.Machine, proposition: int) -> bool:
    """Say whether a proposition is `not (C for e) for d` with e at least d. C is false at the
    beginning, and has to be true for e before the outer `for` can end.
    """
    node = machine.propositions[proposition].node
    if not isinstance(node, ir.Held):
        return False
    negated = machine.propositions[node.operand].node
    inner = machine.propositions[negated.operand].node if isinstance(negated, ir.Not) else None
    return isinstance(inner, ir.Held) and inner.duration_ns >= node.duration_ns


def _wanted(world: RuleFormulas, goal: TraceGoal) -> list[z3.BoolRef]:
    true, false = (world.formula(goal.decision, {goal.subject: value}) for value in (True, False))
    wanted = [true != false]
    atom = world.formula(goal.subject)
    match goal.aspect:
        case Aspect.TRUE:
            wanted.append(atom)
        case Aspect.FALSE:
            wanted.append(z3.Not(atom))
        case (
            Aspect.ACTIVE | Aspect.CLEARED | Aspect.UNDER | Aspect.AT | Aspect.OVER | Aspect.STALE
        ):  # fmt: skip
            pass
    found = edges(world.machine, goal.subject)
    is_array = isinstance(world.machine.propositions[goal.subject].node, ir.Quantified)
    if found and not is_array and goal.aspect not in (Aspect.TRUE, Aspect.FALSE):
        edge = found[goal.edge]
        value, threshold = world.signal(edge.signal), constant(edge.threshold)
        reach = constant(edge.step * 2)
        wanted += {
            Aspect.UNDER: [is_apart(edge, threshold - value), value >= threshold - reach],
            Aspect.AT: [value == threshold],
            Aspect.OVER: [is_apart(edge, value - threshold), value <= threshold + reach],
        }[goal.aspect]
    return wanted
