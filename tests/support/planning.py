"""Plans for skills of tests."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from dslkit.diagnostics import Diagnostic
from ezskiros.driver import Checked
from ezskiros.planning.plan import Plan, find_plan
from support.tree_files import SCENE, checked_text, hall

PREFIXES = """\
@prefix cora: <http://www.inf.ufrgs.br/phi-group/ontologies/cora.owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix rparts: <http://www.inf.ufrgs.br/phi-group/ontologies/RParts.owl#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
"""


def planned(
    skills: Checked, goal: str, scene: Path = SCENE, seconds: float = 60.0
) -> tuple[Plan | None, Sequence[Diagnostic]]:
    """A plan for a goal, and what is said of it."""
    with hall():
        return find_plan(skills.library, scene, goal, seconds)


def names(plan: Plan | None) -> list[str]:
    """The skills of a plan."""
    assert plan is not None
    return [step.action.skill.name for step in plan.steps]


def skill(name: str, parameters: str, *conditions: str) -> str:
    """A skill with an implementation; `pre Object.at(Place)` is one of its conditions."""
    lines = [f"class {name}(SkillDescription):", f"    def description(self, {parameters}):"]
    for each in conditions:
        kind, _, text = each.partition(" ")
        lines.append(f"        self.{kind}_conditions += {text}")
    lines += [
        f"class {name.lower()}_({name}.SkillBase):",
        "    def execute(self):",
        "        return self.success('done')",
    ]
    return "\n".join(lines) + "\n"


def world(folder: Path, text: str, skills: str) -> tuple[Checked, Path]:
    """Skills and a scene in a folder."""
    scene = folder / "lab.turtle"
    scene.write_text(PREFIXES + text, encoding="utf-8")
    return checked_text(skills, folder), scene
