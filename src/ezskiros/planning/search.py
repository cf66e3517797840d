"""The search for a plan that leads to goals, and the reasons why there is none."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from dslkit.diagnostics import Diagnostic, Remark, listed
from dslkit.source import Span
from ezskiros.engine.world import World
from ezskiros.learning.lessons import Cost
from ezskiros.ontology.iris import THING
from ezskiros.ontology.model import Model
from ezskiros.planning import errors
from ezskiros.planning.actions import Action
from ezskiros.planning.facts import Literal, is_so, spelled
from ezskiros.planning.goals import Goal
from ezskiros.planning.pddl import Problem, Step
from ezskiros.planning.reach import Missing, Reach
from ezskiros.planning.reach import TimeOverError as ReachTimeOverError
from ezskiros.planning.solve import TimeOverError, shortened, solve, tried


@dataclass(frozen=True)
class Search:
    """The search for a plan. `start` gives a fresh world model with what is so at the start; it may
    take `seconds` to find what is out of reach, and as long to find a plan.
    """

    start: Callable[[], World]
    model: Model
    actions: Sequence[Action]
    goals: Sequence[Goal]
    seconds: float
    costs: Sequence[Cost] = ()
    """The time that skills are known to lose to rules."""

    def run(self) -> tuple[Sequence[Step] | None, Sequence[Diagnostic]]:
        """The steps, or why there are none. Raises `NoPlannerError`."""
        span = self.goals[0].span.to(self.goals[-1].span)
        wanted = [each.literal for each in self.goals]
        world = self.start()
        if all(is_so(each, world) for each in wanted):
            return [], [errors.GoalIsMet().at(span)]
        if not self.actions:
            return None, [errors.NoSkillsToPlan().at(span)]
        things = world.things(THING)
        try:
            reach = Reach(world, things, self.actions, time.monotonic() + self.seconds)
            blocked = [
                self._out_of_reach(each, reach.missing(each.literal))
                for each in self.goals
                if not reach.is_possible(each.literal)
            ]
            if blocked:
                return None, blocked
            problem = Problem(self.actions, wanted, world, things, self.costs)
            steps = solve(problem, self.seconds)
        except (TimeOverError, ReachTimeOverError):
            return None, [errors.PlanningTimeOver(seconds=self.seconds).at(span)]
        if steps is None:
            return None, [errors.GoalsTogether().at(span)]
        return self._confirmed(steps, wanted, span)

    def _confirmed(
        self, steps: Sequence[Step], wanted: Sequence[Literal], span: Span
    ) -> tuple[Sequence[Step] | None, Sequence[Diagnostic]]:
        """The steps that have to be, if they lead to the goals in the world model."""
        failed = tried(steps, wanted, self.start())
        if failed is not None:
            is_step = failed.number <= len(steps)
            skill = steps[failed.number - 1].action.skill.name if is_step else "the end"
            missing = self._said(failed.needed)
            found = errors.PlanNotConfirmed(number=failed.number, skill=skill, missing=missing)
            return None, [found.at(span)]
        return shortened(steps, wanted, self.start), []

    def _out_of_reach(self, goal: Goal, missing: Missing) -> Diagnostic:
        """The finding for a goal, with the way from it to what is missing."""
        found = errors.GoalOutOfReach(missing=self._said(goal.literal))
        notes: list[Remark] = [
            found.Needs(skill=skill, needed=self._said(each))
            for skill, each in reversed(missing.chain)
        ]
        lacking = self._said(missing.literal)
        if missing.without is not None:
            owl_class = self.model.short(missing.without)
            name, _ = missing.chain[0]
            notes[-1] = found.NeedsThing(skill=name, owl_class=owl_class)
        elif missing.circular:
            notes.append(found.Circular(missing=lacking, skills=listed(missing.circular)))
        else:
            notes.append(found.Missing(missing=lacking))
        return found.at(goal.span, notes=notes)

    def _said(self, literal: Literal) -> str:
        model = self.model
        return f"`{spelled(literal, model, model.short)}`"
