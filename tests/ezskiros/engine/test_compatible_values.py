"""With `--compatible` values are those that were recorded from real SkiROS2: tests/ezskiros/hosts
records them again.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.engine.blackboard import Remaps
from ezskiros.engine.events import Happened
from support import random_values, skiros2_individuals, skiros2_values
from support.engine import Ran, Skills
from support.passed_values import skills as passing


def reported(ran: Ran, primitives: tuple[str, ...], *ends: Happened) -> list[str]:
    """The texts of the primitives that end so."""
    found = [each for each in ran.events if each.happened in ends]
    return [each.text for each in found if each.path[-1].lower().startswith(primitives)]


@pytest.mark.parametrize(("tree", "recorded"), skiros2_values.TREES, ids=skiros2_values.IDS)
def test_values_are_those_of_skiros2(tmp_path: Path, tree: str, recorded: list[str]) -> None:
    skills = Skills(tmp_path, passing(tree), options={"compatible": True})
    ran = skills.run("Task", "Mine=8.0")
    ends = (Happened.SUCCEEDED, Happened.FAILED)
    assert reported(ran, skiros2_values.PRIMITIVES, *ends) == recorded
    assert ran.outcome.is_success


@pytest.mark.parametrize(
    ("tree", "succeeds", "recorded"), skiros2_individuals.TREES, ids=skiros2_individuals.IDS
)
def test_individuals_are_those_of_skiros2(
    tmp_path: Path, tree: str, succeeds: bool, recorded: list[str]
) -> None:
    source, scene = skiros2_individuals.skills(tree), skiros2_individuals.SCENE
    skills = Skills(tmp_path, source, scene, options={"compatible": True})
    ran = skills.run("Task", "A=bench", "B=shelf", "Object=nut")
    texts = reported(ran, skiros2_individuals.PRIMITIVES, Happened.SUCCEEDED)
    assert (ran.outcome.is_success, texts) == (succeeds, recorded)


@pytest.mark.parametrize("seed", random_values.recorded())
def test_random_skills_note_what_they_note_in_skiros2(tmp_path: Path, seed: int) -> None:
    skills = random_values.skills_of(seed)
    assert random_values.noted_here(skills, tmp_path) == random_values.recorded()[seed]


def test_what_is_set_before_a_failed_start_is_there_where_the_value_was_from(
    tmp_path: Path,
) -> None:
    source = passing("self.nofail(Grow(Force=params.Mine)), Tell(Force=params.Mine)").replace(
        "class grow(Grow.SkillBase):\n",
        "class grow(Grow.SkillBase):\n"
        "    def onStart(self):\n        self.params.Force = 3.0\n        return False\n\n",
    )
    ran = Skills(tmp_path, source, options={"compatible": True}).run("Task", "Mine=8.0")
    assert ran.notes[-2] == "3.0 4.0"


def test_all_skills_have_a_robot_in_skiros2() -> None:
    remaps = Remaps(["Machine", "Force"])
    remaps.add("Machine", "Robot")
    remaps.add("Force", "Mine")
    assert remaps.by_own() == {"Machine": "Machine", "Force": "Mine", "Robot": "Robot"}
