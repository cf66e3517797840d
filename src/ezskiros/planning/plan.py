"""From skills, a scene and a goal to a plan that has been tried out."""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit.diagnostics import Diagnostic, Remark, Severity, listed
from dslkit.source import SourceFile, Span, is_file
from ezskiros.check.scene_errors import NoOntologyForScene
from ezskiros.learning.lessons import Cost
from ezskiros.ontology.iris import THING
from ezskiros.ontology.load import load_named
from ezskiros.planning import errors
from ezskiros.planning.actions import Action, actions
from ezskiros.planning.facts import Literal, is_so, spelled
from ezskiros.planning.goals import Goal, GoalError, goals
from ezskiros.planning.pddl import Problem, Step
from ezskiros.planning.prices import expected_s
from ezskiros.planning.reach import Missing, Reach
from ezskiros.planning.reach import TimeOverError as ReachTimeOverError
from ezskiros.planning.scene import Scene, read_scene
from ezskiros.planning.solve import TimeOverError, shortened, solve, tried
from ezskiros.skills.load_errors import NoFile
from ezskiros.trees.library import Library


@dataclass(frozen=True)
class Plan:
    """Skills that lead from a scene to goals, one after the other."""

    steps: Sequence[Step]
    goals: Sequence[Goal]
    scene: Scene
    costs: Sequence[Cost] = ()
    """The time that skills are known to lose to rules."""

    @property
    def expected_s(self) -> float:
        """The seconds that it is expected to lose to rules."""
        return sum(
            expected_s(each.action.skill.name, each.things, self.costs) for each in self.steps
        )


def find_plan(
    library: Library, scene_path: Path, goal: str, seconds: float, costs: Sequence[Cost] = ()
) -> tuple[Plan | None, Sequence[Diagnostic]]:
    """A plan, and what is to be said of it: why there is none, and which skills are left out. With
    costs it is the one that is expected to lose the least time to rules, as far as that is found.

    Raises `NoPlannerError` if the planner is not installed.
    """
    nowhere = Span(SourceFile(str(scene_path), ""), 0, 0)
    own = library.ontology()  # skills that say nothing of things know none
    ontology, found = (own, []) if own else load_named()
    if not is_file(scene_path):
        return None, [NoFile(path=str(scene_path)).at(nowhere)]
    if ontology is None:
        return None, [NoOntologyForScene().at(nowhere)]
    if _has_error(found):
        return None, found
    scene, wrong = read_scene(scene_path, ontology)
    found = [*found, *wrong]
    if scene is None or _has_error(found):
        return None, found
    try:
        wanted = goals(goal, ontology.model, scene.names())
    except GoalError as problem:
        return None, [*found, problem.diagnostic]
    known, left_out = actions(library, ontology.model)
    search = _Search(scene, known, wanted, seconds, costs)
    steps, more = search.run()
    plan = Plan(steps, wanted, scene, costs) if steps is not None else None
    return plan, [*found, *(left_out if steps is None else ()), *more]


def _has_error(found: Iterable[Diagnostic]) -> bool:
    return any(each.severity is Severity.ERROR for each in found)


@dataclass(frozen=True)
class _Search:
    scene: Scene
    actions: Sequence[Action]
    goals: Sequence[Goal]
    seconds: float
    costs: Sequence[Cost]

    def run(self) -> tuple[Sequence[Step] | None, Sequence[Diagnostic]]:
        """The steps, or why there are none."""
        span = self.goals[0].span.to(self.goals[-1].span)
        wanted = [each.literal for each in self.goals]
        world = self.scene.world()
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
        failed = tried(steps, wanted, self.scene.world())
        if failed is not None:
            is_step = failed.number <= len(steps)
            skill = steps[failed.number - 1].action.skill.name if is_step else "the end"
            missing = self._said(failed.needed)
            found = errors.PlanNotConfirmed(number=failed.number, skill=skill, missing=missing)
            return None, [found.at(span)]
        return shortened(steps, wanted, self.scene.world), []

    def _out_of_reach(self, goal: Goal, missing: Missing) -> Diagnostic:
        """The finding for a goal, with the way from it to what is missing."""
        found = errors.GoalOutOfReach(missing=self._said(goal.literal))
        notes: list[Remark] = [
            found.Needs(skill=skill, needed=self._said(each))
            for skill, each in reversed(missing.chain)
        ]
        lacking = self._said(missing.literal)
        if missing.without is not None:
            owl_class = self.scene.ontology.model.short(missing.without)
            name, _ = missing.chain[0]
            notes[-1] = found.NeedsThing(skill=name, owl_class=owl_class)
        elif missing.circular:
            notes.append(found.Circular(missing=lacking, skills=listed(missing.circular)))
        else:
            notes.append(found.Missing(missing=lacking))
        return found.at(goal.span, notes=notes)

    def _said(self, literal: Literal) -> str:
        model = self.scene.ontology.model
        return f"`{spelled(literal, model, model.short)}`"
