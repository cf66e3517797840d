"""Planning: from skills, a scene and a goal to a plan that was replayed on the world model."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit.diagnostics import Diagnostic, Severity
from dslkit.source import SourceFile, Span, is_file
from ezskiros.check.scene_errors import NoOntologyForScene
from ezskiros.learning.lessons import Cost
from ezskiros.ontology.load import load_named
from ezskiros.planning.actions import actions
from ezskiros.planning.goals import Goal, GoalError, goals
from ezskiros.planning.pddl import PlanStep
from ezskiros.planning.prices import expected_s
from ezskiros.planning.scene import PlanningScene, read_scene
from ezskiros.planning.search import Search
from ezskiros.skills.load_errors import NoFile
from ezskiros.trees.library import Library


@dataclass(frozen=True)
class Plan:
    """Skills that lead from a scene to goals, one after the other."""

    steps: Sequence[PlanStep]
    goals: Sequence[Goal]
    scene: PlanningScene
    costs: Sequence[Cost] = ()
    """The known losses of time to rules."""

    @property
    def expected_s(self) -> float:
        """The expected loss to rules in seconds."""
        return sum(
            expected_s(each.action.skill.name, each.individuals, self.costs) for each in self.steps
        )


def find_plan(
    library: Library, scene_path: Path, goal: str, seconds: float, costs: Sequence[Cost] = ()
) -> tuple[Plan | None, Sequence[Diagnostic]]:
    """A plan, and the findings: the reason why there is none, and the omitted skills. With costs,
    it is the plan with the least expected loss of time that was found.

    Raises `NoPlannerError` if the planner is not installed.
    """
    nowhere = Span(SourceFile(str(scene_path), ""), 0, 0)
    own = library.ontology()  # skills without conditions about individuals know no ontology
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
    search = Search(scene.world, ontology.model, known, wanted, seconds, costs)
    steps, more = search.run()
    plan = Plan(steps, wanted, scene, costs) if steps is not None else None
    return plan, [*found, *(left_out if steps is None else ()), *more]


def _has_error(found: Iterable[Diagnostic]) -> bool:
    return any(each.severity is Severity.ERROR for each in found)
