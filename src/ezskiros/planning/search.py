"""The search for a plan, and the reasons if there is none."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from dslkit.diagnostics import Diagnostic, Remark, listed
from dslkit.source import Span
from ezskiros.engine.prohibitions import Prohibition
from ezskiros.engine.world import World
from ezskiros.learning.lessons import Cost
from ezskiros.ontology.iris import THING
from ezskiros.ontology.model import Model
from ezskiros.planning import errors
from ezskiros.planning.actions import PlanningAction
from ezskiros.planning.facts import FluentLiteral, is_so, spelled
from ezskiros.planning.forbidden import permitted, stopped_by
from ezskiros.planning.goals import Goal
from ezskiros.planning.pddl import PlanStep, Problem
from ezskiros.planning.reach import MissingFact, ReachableFacts, ReachTimeOverError
from ezskiros.planning.solve import TimeOverError, shortened, solve, tried

_MOST_STEPS = 3
"""The most steps that a message names."""


@dataclass(frozen=True)
class Search:
    """The search for a plan. `start` returns a new world model with the initial facts. The search
    may take `seconds` to find unreachable goals, and as long again to find a plan.
    """

    start: Callable[[], World]
    model: Model
    actions: Sequence[PlanningAction]
    goals: Sequence[Goal]
    seconds: float
    costs: Sequence[Cost] = ()
    """The known losses of time to rules."""
    without: Sequence[Prohibition] = ()
    """The skills that rules always stop."""

    def run(self) -> tuple[Sequence[PlanStep] | None, Sequence[Diagnostic]]:
        """The steps, or the reasons why there are none. Raises `NoPlannerError`."""
        span = self.goals[0].span.to(self.goals[-1].span)
        wanted = [each.literal for each in self.goals]
        world = self.start()
        if all(is_so(each, world) for each in wanted):
            return [], [errors.GoalIsMet().at(span)]
        if not self.actions:
            return None, [errors.NoSkillsToPlan().at(span)]
        individuals, actions = world.individuals(THING), permitted(self.actions, self.without)
        try:
            reach = ReachableFacts(world, individuals, actions, time.monotonic() + self.seconds)
            blocked = [each for each in self.goals if not reach.is_possible(each.literal)]
            if blocked:
                return None, [*self._blocked(blocked, reach)]
            problem = Problem(actions, wanted, world, individuals, self.costs)
            steps = solve(problem, self.seconds)
        except (TimeOverError, ReachTimeOverError):
            return None, [errors.PlanningTimeOver(seconds=self.seconds).at(span)]
        if steps is None:
            return None, [self._not_together(span)]
        return self._confirmed(steps, wanted, span)

    def _not_together(self, span: Span) -> Diagnostic:
        found = errors.GoalsTogether()
        steps = dict.fromkeys(self._said_kind(each) for each in self.without)
        return found.at(span, notes=[found.Forbidden(steps=_few([*steps]))] if steps else ())

    def _said_kind(self, found: Prohibition) -> str:
        """The words `Drive(Target = a skiros:Location)`."""
        individuals = found.individuals
        return _called(
            found.skill, [f"{name} = a {self.model.short(it)}" for name, it in individuals]
        )

    def _confirmed(
        self, steps: Sequence[PlanStep], wanted: Sequence[FluentLiteral], span: Span
    ) -> tuple[Sequence[PlanStep] | None, Sequence[Diagnostic]]:
        """The necessary steps, if they reach the goals in the world model."""
        failed = tried(steps, wanted, self.start())
        if failed is not None:
            is_step = failed.number <= len(steps)
            skill = steps[failed.number - 1].action.skill.name if is_step else "the end"
            missing = self._said(failed.needed)
            found = errors.PlanNotConfirmed(number=failed.number, skill=skill, missing=missing)
            return None, [found.at(span)]
        return shortened(steps, wanted, self.start), []

    def _blocked(self, goals: Sequence[Goal], reach: ReachableFacts) -> Iterator[Diagnostic]:
        """The findings for unreachable goals."""
        stopped = self._stopped(reach) if self.without else []
        free = (
            ReachableFacts(reach.world, reach.individuals, self.actions, reach.until)
            if stopped
            else reach
        )
        for goal in goals:
            found = errors.GoalOutOfReach(missing=self._said(goal.literal))
            if free.is_possible(goal.literal):
                yield found.at(goal.span, notes=[found.Forbidden(steps=_few(stopped))])
            else:
                yield self._out_of_reach(goal, reach.missing(goal.literal))

    def _stopped(self, reach: ReachableFacts) -> list[str]:
        """The steps that are possible and would help, if rules did not stop them."""
        found: dict[str, None] = {}
        for action in self.actions:
            for bound in reach.bindings(action):
                why = stopped_by(action, bound, self.without, reach.world)
                if why is not None and reach.leads_on(action, bound):
                    found[self._said_step(why, bound)] = None
        return [*found]

    def _said_step(self, why: Prohibition, individuals: Mapping[str, str]) -> str:
        """The words `Drive(Target = skiros:Location-3)`."""
        names = dict.fromkeys(name for name, _ in why.individuals)
        return _called(
            why.skill, [f"{each} = {self.model.short(individuals[each])}" for each in names]
        )

    def _out_of_reach(self, goal: Goal, missing: MissingFact) -> Diagnostic:
        """The finding for a goal, with the skills between the goal and the missing fact."""
        found = errors.GoalOutOfReach(missing=self._said(goal.literal))
        notes: list[Remark] = [
            found.Needs(skill=skill, needed=self._said(each))
            for skill, each in reversed(missing.chain)
        ]
        lacking = self._said(missing.literal)
        if missing.without is not None:
            owl_class = self.model.short(missing.without)
            name, _ = missing.chain[0]
            notes[-1] = found.NeedsIndividual(skill=name, owl_class=owl_class)
        elif missing.circular:
            notes.append(found.Circular(missing=lacking, skills=listed(missing.circular)))
        else:
            notes.append(found.Missing(missing=lacking))
        return found.at(goal.span, notes=notes)

    def _said(self, literal: FluentLiteral) -> str:
        model = self.model
        return f"`{spelled(literal, model, model.short)}`"


def _called(skill: str, individuals: Sequence[str]) -> str:
    return f"{skill}({', '.join(individuals)})" if individuals else skill


def _few(steps: Sequence[str]) -> str:
    more = len(steps) - _MOST_STEPS
    return listed(steps[:_MOST_STEPS]) + (f", and {more} more" if more > 0 else "")
