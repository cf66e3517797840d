"""Grounding: the values of a skill's parameters at its start, and its pre-conditions."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from ezskiros.engine.conditions import holds, reason
from ezskiros.engine.events import Code, Reason
from ezskiros.engine.execution_context import ExecutionContext
from ezskiros.engine.inference import Solution, infer
from ezskiros.engine.plans import ChildStart
from ezskiros.engine.values import WorldIndividual, wanted
from ezskiros.engine.world import World
from ezskiros.skills.interface import Clause, Parameter


@dataclass
class SharedValues:
    """The values that the children of one tree share, by name."""

    values: dict[str, Any]
    inferred: set[str] = field(default_factory=set)
    """Names whose values a child has inferred. Another child may have to infer them again."""


def missing(plan: ChildStart, values: Mapping[str, Any]) -> Reason | None:
    """The reason why a skill cannot start with these values; None if it can."""
    for parameter in plan.needed:
        if values[parameter.name] is None:
            text = f"`{parameter.name}`, {wanted(parameter)}, has no value ({parameter.span})"
            return Reason(Code.START, text)
    for parameter in plan.individuals:
        value = values[parameter.name]
        if value is not None and not value._world.is_a(value.iri, parameter.iri):  # noqa: SLF001
            text = f"`{parameter.name}` must be {wanted(parameter)}, but {value} is not"
            return Reason(Code.START, f"{text} ({parameter.span})")
    return None


def missing_output(plan: ChildStart, values: Mapping[str, Any]) -> Reason | None:
    """The reason why a skill has not set one of its outputs; None if all are set."""
    for parameter in plan.outputs:
        if values[parameter.name] is None:
            reported = f"the skill has not set `{parameter.name}`"
            return Reason(Code.POST, f"{reported} ({parameter.span})")
    return None


class Grounding:
    """Finds individuals for inferred parameters, and stores them in `values`."""

    def __init__(
        self,
        plan: ChildStart,
        names: SharedValues,
        values: dict[str, Any],
        execution: ExecutionContext,
    ) -> None:
        self._plan, self._names, self._values = plan, names, values
        self._execution, self._world = execution, execution.world
        self.chosen: tuple[Solution, Sequence[Solution]] | None = None
        """The chosen solution, and all solutions; None if there was no choice."""

    def ground(self) -> Reason | None:
        """Infer missing parameters. Returns the reason why the skill cannot start, or None.

        An individual that another child inferred is kept while the pre-conditions hold with it.
        SkiROS2 always keeps it.
        """
        plan, values = self._plan, self._values
        free = [each for each in plan.inferred if values[each.name] is None]
        problem = self._inferred(free) if free else broken_pre(plan, values, self._world)
        if problem is None or self._execution.compatible:
            return problem
        shared = dict(plan.shared)
        stale = [
            each
            for each in plan.inferred
            if each not in free and shared.get(each.name) in self._names.inferred
        ]
        if not stale:
            return problem
        values.update({each.name: None for each in stale})
        return self._inferred([*free, *stale])

    def _inferred(self, free: Sequence[Parameter]) -> Reason | None:
        plan, world = self._plan, self._world
        given, is_equality = bound(self._values), self._execution.compatible
        found = infer(plan.skill, free, given, world, is_equality=is_equality)
        if found.without_candidates:
            first = found.without_candidates[0]
            text = f"the world has no individual for `{first.name}`, {wanted(first)} ({first.span})"
            return Reason(Code.PRE, text)
        if not found.solutions:
            return _impossible(plan, free, given, self._execution)
        taken = found.solutions[0]
        if len(found.solutions) > 1:
            taken = self._execution.choose(plan.skill, found.solutions)
            self.chosen = (taken, found.solutions)
        shared = dict(plan.shared)
        for name, iri in taken.items():
            self._values[name] = WorldIndividual(iri, world)
            if name in shared:
                self._names.inferred.add(shared[name])
        return broken_pre(plan, self._values, world)


def bound(values: Mapping[str, Any]) -> dict[str, str]:
    """The individuals among some values, as IRIs."""
    return {name: each.iri for name, each in values.items() if type(each) is WorldIndividual}


def broken_pre(plan: ChildStart, values: Mapping[str, Any], world: World) -> Reason | None:
    """The first pre-condition that does not hold."""
    return broken(plan.skill.pre, "pre-condition does not hold", Code.PRE, values, world)


def broken(
    clauses: Iterable[Clause], reported: str, code: Code, values: Mapping[str, Any], world: World
) -> Reason | None:
    """The first condition that does not hold: its text, its place, and the facts of the world."""
    if not clauses:
        return None
    individuals = bound(values)
    for clause in clauses:
        if not holds(clause.statement, individuals, world):
            why = reason(clause.statement, individuals, world)
            return Reason(code, f"{reported}: {_written(clause)}: {why}")
    return None


def _impossible(
    plan: ChildStart,
    free: Sequence[Parameter],
    given: Mapping[str, str],
    execution: ExecutionContext,
) -> Reason:
    """The first pre-condition that leaves no individual for the free parameters."""
    skill, world, is_equality = plan.skill, execution.world, execution.compatible
    known = {**given}
    for count in range(1, len(skill.pre) + 1):
        shorter = replace(skill, pre=skill.pre[:count])
        found = infer(shorter, free, given, world, is_equality=is_equality).solutions
        if not found:
            clause = skill.pre[count - 1]
            why = reason(clause.statement, known, world)
            text = f"pre-condition does not hold: {_written(clause)}: {why}"
            return Reason(Code.PRE, text)
        known |= found[0]
    return Reason(Code.PRE, "nothing in the world satisfies the pre-conditions")


def _written(clause: Clause) -> str:
    return f"{' '.join(clause.span.text.split())} ({clause.span})"
