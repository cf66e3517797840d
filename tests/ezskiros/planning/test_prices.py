"""Plans by what runs have shown to cost time."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from ezskiros.driver import Checked
from ezskiros.learning.lessons import Cost
from ezskiros.planning import solve
from ezskiros.planning.plan import Plan, find_plan
from support.planning import names, skill, world
from support.tree_files import hall

SCENE = """
cora:Robot-1 a cora:Robot ; rdfs:label "robot" ; skiros:at skiros:Location-2 .
skiros:Location-2 a skiros:Location ; rdfs:label "gate" .
skiros:Location-3 a skiros:Location ; rdfs:label "ramp" .
skiros:Location-4 a skiros:Location ; rdfs:label "hall" .
skiros:Location-5 a skiros:Location ; rdfs:label "goal" .
"""
SKIROS = "http://rvmi.aau.dk/ontologies/skiros.owl#"
AROUND = skill("Around", "Robot: cora.Robot, Via: skiros.Location, To: skiros.Location",
    "pre ~Robot.at(To)", "post Robot.at(To)")  # fmt: skip
STRAIGHT = skill("Straight", "Robot: cora.Robot, To: skiros.Location",
    "pre ~Robot.at(To)", "post Robot.at(To)")  # fmt: skip
CAREFUL = skill("Careful", "Robot: cora.Robot, To: skiros.Location",
    "pre ~Robot.at(To)", "post Robot.at(To)")  # fmt: skip
UNENDING = r"""
import time

for number in (1, 2):
    with open(f"plan.{number}", "w") as plan:
        plan.write(f"(skill_{number - 1} individual_4 individual_3)\n")
        plan.write(f"; cost = {30 - number} (general cost)\n")
with open("plan.3", "w") as plan:
    plan.write("(skill_0 ind")
time.sleep(600)
"""
GOAL = "(skiros:at robot goal)"


def iri(number: int) -> str:
    return f"{SKIROS}Location-{number}"


def cost(skill: str, lost_s: float, executions: int = 1, **places: int) -> Cost:
    found = tuple(sorted((name, iri(number)) for name, number in places.items()))
    return Cost(skill, found, executions, executions, lost_s)


def planned(found: tuple[Checked, Path], costs: Sequence[Cost], seconds: float = 60.0) -> Plan:
    checked, scene = found
    with hall():
        plan, said = find_plan(checked.library, scene, GOAL, seconds, costs)
    assert plan is not None, [each.title for each in said]
    return plan


@pytest.mark.parametrize(
    ("costs", "expected"),
    [
        ([cost("Straight", 8.0), cost("Careful", 2.0)], "Careful"),
        ([cost("Straight", 1.0), cost("Careful", 2.0)], "Straight"),
        ([cost("Straight", 8.0, To=3), cost("Careful", 2.0)], "Straight"),
        ([cost("Straight", 8.0, To=5), cost("Careful", 2.0)], "Careful"),
        ([cost("Straight", 8.0, 10, To=5), cost("Careful", 2.0)], "Straight"),
        ([cost("Straight", 1e300), cost("Careful", 2.0, 3)], "Careful"),
    ],
    ids=["dear", "cheap", "dear elsewhere", "dear here", "seldom dear", "very dear"],
)
def test_the_cheaper_skill_is_taken(costs: Sequence[Cost], expected: str, tmp_path: Path) -> None:
    plan = planned(world(tmp_path, SCENE, STRAIGHT + CAREFUL), costs)
    assert names(plan) == [expected]


@pytest.mark.parametrize("dear", [3, 4])
def test_places_are_chosen_by_what_they_cost(dear: int, tmp_path: Path) -> None:
    """All that is not known to cost anything is as good, so all others are made dear."""
    free = 7 - dear
    costs = [cost("Around", 9.0, Via=via, To=5) for via in (2, dear)]
    plan = planned(world(tmp_path, SCENE, AROUND), costs)
    assert [dict(each.individuals)["Via"] for each in plan.steps] == [iri(free)]
    assert plan.expected_s == 0


def test_a_detour_of_one_step_is_worth_a_second(tmp_path: Path) -> None:
    """Two steps around, or one straight: each step is worth a second."""
    lift = skill("Lift", "Robot: cora.Robot, To: skiros.Location",
        "pre ~Robot.at(To)", "pre Robot.at(Start)", "post Robot.at(To)").replace(
        "Robot: cora.Robot, To", "Robot: cora.Robot, Start: skiros.Location, To")  # fmt: skip
    found = world(tmp_path, SCENE, lift)
    for lost, steps in ((0.5, 1), (1.5, 2)):
        plan = planned(found, [cost("Lift", lost, Start=2, To=5)])
        assert len(plan.steps) == steps, lost
    assert plan.expected_s == 0


def test_what_a_plan_is_expected_to_lose_is_reported(tmp_path: Path) -> None:
    plan = planned(world(tmp_path, SCENE, STRAIGHT), [cost("Straight", 9.0, 2, To=5)])
    assert plan.expected_s == 4.5


def test_costs_of_individuals_and_parameters_that_are_not_there_do_no_harm(tmp_path: Path) -> None:
    costs = [cost("Straight", 9.0, To=77), cost("Straight", 9.0, Gone=5), cost("Other", 1.0)]
    assert names(planned(world(tmp_path, SCENE, STRAIGHT), costs)) == ["Straight"]


def test_a_search_that_is_ended_gives_the_best_plan_so_far(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A planner that has found two plans, is at a third, and does not end."""
    program = tmp_path / "planner.py"
    program.write_text(UNENDING, encoding="utf-8")
    monkeypatch.setattr(solve, "_program", lambda: program)
    plan = planned(world(tmp_path, SCENE, STRAIGHT + CAREFUL), [cost("Straight", 1.0)], 2.0)
    assert names(plan) == ["Careful"]
