"""Plans lead to their goals; without one it is said what is missing."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from ezskiros.driver import Checked
from ezskiros.planning import solve as planner
from ezskiros.planning.facts import is_so
from ezskiros.planning.pddl import PlanStep, Problem
from ezskiros.planning.plan import Plan
from ezskiros.planning.solve import tried
from ezskiros.planning.source import source
from support import command_line
from support.golden import assert_golden
from support.ontologies import HALL
from support.planning import names, planned, skill, world
from support.tree_files import TREES

GOLDEN = Path(__file__).parent / "golden"
ROBOT = """\
cora:Robot-9 a cora:Robot ; skiros:at skiros:Location-1 .
skiros:Location-1 a skiros:Location . skiros:Location-2 a skiros:Location .
skiros:Location-3 a skiros:Location .
skiros:Product-4 a skiros:Product ; skiros:Weight 2.0 . skiros:Product-5 a skiros:Product .
"""
DRIVE = skill(
    "Drive",
    "Robot: cora.Robot, Start: INFERRED[skiros.Location], Target: skiros.Location",
    "pre Robot.at(Start)",
    "post Robot.at(Target)",
)


def test_a_plan_leads_to_its_goal(gripping: Checked) -> None:
    plan, said = planned(gripping, "(skiros:contain shelf starter)")
    assert list(said) == []
    assert plan is not None
    assert names(plan) in (["Fetch", "Release"], ["Approach", "Grip", "Approach", "Release"])
    goals = [each.literal for each in plan.goals]
    assert tried(plan.steps, goals, plan.scene.world()) is None
    assert not is_so(goals[0], plan.scene.world())


@pytest.mark.parametrize(
    "goal",
    [
        "(skiros:contain skiros:Location-2 skiros:Product-3)",
        "( contain shelf   starter ),",
        '(contain "shelf" "starter")',
        "(contain http://rvmi.aau.dk/ontologies/skiros.owl#Location-2 starter)",
    ],
)
def test_the_same_goal_in_other_words(gripping: Checked, goal: str) -> None:
    assert len(names(planned(gripping, goal)[0])) >= 2


def test_several_goals_and_one_that_is_not_to_be(gripping: Checked) -> None:
    goal = "(contain shelf starter), (at gripper bench) (not (contain gripper starter))"
    found = names(planned(gripping, goal)[0])
    assert found[-1] == "Approach"
    assert "Release" in found


def test_functional_relations_push_out_the_old_value(tmp_path: Path) -> None:
    """A robot is at one place: driving to the second leaves the first."""
    found, scene = world(tmp_path, ROBOT, DRIVE)
    plan, _ = planned(found, "(not (at cora:Robot-9 skiros:Location-1))", scene)
    assert names(plan) == ["Drive"]


def test_a_goal_that_is_met_and_that_no_skill_is_about_does_no_harm(tmp_path: Path) -> None:
    scene_text = ROBOT + "skiros:Location-3 skiros:contain skiros:Product-5 .\n"
    found, scene = world(tmp_path, scene_text, DRIVE)
    goal = (
        "(skiros:contain skiros:Location-3 skiros:Product-5), (at cora:Robot-9 skiros:Location-2)"
    )
    plan, _ = planned(found, goal, scene)
    assert names(plan) == ["Drive"]


def test_a_property_has_one_value_at_a_time(tmp_path: Path) -> None:
    heat = skill(
        "Heat", "Object: skiros.Product", "pre Object.Weight == 2.0", "post Object.Weight == 5.0"
    )
    lift = skill(
        "Lift",
        "Object: skiros.Product, Place: skiros.Location",
        "pre Object.Weight > 4.0",
        "pre Object.Weight != 2.0",
        "post Place.contain(Object)",
    )
    found, scene = world(tmp_path, ROBOT, heat + lift)
    plan, _ = planned(found, "(contain skiros:Location-1 skiros:Product-4)", scene)
    assert names(plan) == ["Heat", "Lift"]
    plan, _ = planned(found, "(skiros:Weight skiros:Product-4 5.0)", scene)
    assert names(plan) == ["Heat"]


def test_a_skill_that_nothing_makes_available(tmp_path: Path) -> None:
    head, _, body = DRIVE.rpartition(".SkillBase):\n")
    switched = f"{head}.SkillBase):\n    available_for_planning = False\n{body}"
    other = f"\n\nclass drive_too(Drive.SkillBase):\n{body}"
    for number, (text, count) in enumerate([(switched, 0), (switched + other, 1)]):
        folder = tmp_path / str(number)
        folder.mkdir()
        found, scene = world(folder, ROBOT, text)
        plan, _ = planned(found, "(not (at cora:Robot-9 skiros:Location-1))", scene)
        assert (names(plan) if plan else []) == ["Drive"] * count


def test_one_of_several_conditions_is_enough(tmp_path: Path) -> None:
    either = skill(
        "Move",
        "Robot: cora.Robot, A: skiros.Location, Object: skiros.Product",
        "pre Robot.at(A) | Object.Weight",
        "post A.contain(Object)",
    )
    found, scene = world(tmp_path, ROBOT, either)
    assert names(
        planned(
            found,
            "(contain Location-2 Product-4)".replace("Location", "skiros:Location").replace(
                "Product", "skiros:Product"
            ),
            scene,
        )[0]
    ) == ["Move"]


def test_what_is_consumed_cannot_be_used_again(tmp_path: Path) -> None:
    eat = skill(
        "Eat",
        "Robot: cora.Robot, Object: CONSUME[skiros.Product]",
        "pre Object.Weight",
        "post ~Robot.at(Object)",
    ).replace("~Robot.at(Object)", "Robot.hasA(Object)")
    found, scene = world(tmp_path, ROBOT, eat)
    _, said = planned(found, "(hasA cora:Robot-9 skiros:Product-4)", scene)
    assert [each.code for each in said] == ["EZS858"]


@pytest.mark.parametrize(
    ("goal", "code", "said"),
    [
        ("", "EZS850", "it is empty"),
        ("(contain shelf)", "EZS850", "a relation needs two individuals"),
        ("(contain shelf starter", "EZS850", "`)` is missing here"),
        ("contain shelf starter", "EZS850", "`(` is missing here"),
        ("(not contain shelf starter)", "EZS850", "`(` is missing here"),
        ("(contain shelf starter bench)", "EZS850", "a relation and two individuals"),
        ("(contain shelf stater)", "EZS851", "the scene has no `stater`"),
        ("(contains shelf starter)", "EZS852", "no relation or data property `contains`"),
        ("(contain gripper bench)", "EZS853", "no skill achieves"),
        ("(at gripper shelf)", "EZS859", "the goal already holds"),
        (
            "(contain shelf starter), (contain gripper starter)",
            "EZS854",
            "no sequence of skills reaches all goals together",
        ),
    ],
)
def test_goals_without_a_plan(gripping: Checked, goal: str, code: str, said: str) -> None:
    _, found = planned(gripping, goal)
    assert [each.code for each in found] == [code]
    assert said in found[0].title


@pytest.mark.parametrize("goal", ["((((", '"', "(not", "(not (", ",,,", ")", "(a b c d)", "(())"])
def test_no_goal_is_too_strange(gripping: Checked, goal: str) -> None:
    assert [each.code for each in planned(gripping, goal)[1]] == ["EZS850"]


def test_the_condition_that_blocks_is_said(tmp_path: Path) -> None:
    place = skill(
        "Place",
        "Robot: cora.Robot, Spot: skiros.Location, Object: skiros.Product",
        "pre Robot.at(Spot)",
        "pre Robot.contain(Object)",
        "post Spot.contain(Object)",
    )
    grip = skill(
        "Grip",
        "Robot: cora.Robot, Object: skiros.Product",
        "pre Object.Weight < 1.0",
        "post Robot.contain(Object)",
    )
    found, scene = world(tmp_path, ROBOT, DRIVE + place + grip)
    _, said = planned(found, "(contain skiros:Location-2 skiros:Product-4)", scene)
    assert [each.code for each in said] == ["EZS853"]
    assert list(said[0].notes) == [
        "`Place` needs `cora:Robot-9 skiros:contain skiros:Product-4`",
        "`Grip` needs `skiros:Product-4 skiros:Weight < 1.0`",
        "`skiros:Product-4 skiros:Weight < 1.0` is false in the scene, and no skill achieves it",
    ]


def test_a_class_of_which_there_is_nothing_is_said(tmp_path: Path) -> None:
    tool = skill(
        "Screw",
        "Tool: rparts.GripperEffector, Spot: skiros.Location, Object: skiros.Product",
        "pre ~Tool.contain(Object)",
        "post Spot.contain(Object)",
    )
    found, scene = world(tmp_path, ROBOT, tool)
    _, said = planned(found, "(contain skiros:Location-2 skiros:Product-4)", scene)
    assert said[0].notes == ("`Screw` needs a rparts:GripperEffector, but the scene has none",)


def test_skills_that_cannot_be_planned_with_are_said_if_there_is_no_plan(tmp_path: Path) -> None:
    vague = skill(
        "Vague",
        "Robot: cora.Robot, Spot: skiros.Location, Object: skiros.Product",
        "pre Robot.at(Spot)",
        "post Spot.contain(Object) | Robot.contain(Object)",
    )
    found, scene = world(tmp_path, ROBOT, DRIVE + vague)
    _, said = planned(found, "(contain skiros:Location-2 skiros:Product-4)", scene)
    assert [each.code for each in said] == ["EZS856", "EZS853"]
    plan, said = planned(found, "(at cora:Robot-9 skiros:Location-2)", scene)
    assert (names(plan), list(said)) == (["Drive"], [])


def test_nothing_to_plan_with(tmp_path: Path) -> None:
    found, scene = world(tmp_path, ROBOT, skill("Idle", "Robot: cora.Robot"))
    _, said = planned(found, "(at cora:Robot-9 skiros:Location-2)", scene)
    assert [each.code for each in said] == ["EZS857"]


def test_time_is_limited(gripping: Checked) -> None:
    _, said = planned(gripping, "(contain shelf starter)", seconds=1e-6)
    assert [each.code for each in said] == ["EZS855"]


def test_the_planner_is_ended(gripping: Checked) -> None:
    _, said = planned(gripping, "(contain shelf starter)", seconds=0.05)
    assert [each.code for each in said] == ["EZS855"]


def test_nothing_of_the_planner_runs_in_this_process(lab: Path) -> None:
    """It is under another licence, and a program of its own."""
    program = (
        "import atexit, sys\n"
        "from ezskiros.cli.main import main\n"
        "tops = lambda: {name.partition('.')[0] for name in sys.modules}\n"
        "atexit.register(lambda: print('modules:', *sorted(tops())))\n"
        f"sys.argv = {['ezskiros', 'plan', *GOAL, '--ontology', str(HALL)]!r}\n"
        "main()\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=lab, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    *plan, modules = done.stdout.splitlines()
    assert "Release" in "\n".join(plan)
    assert "ezskiros" in modules.split()
    assert not {"fast_downward", "up_fast_downward", "driver", "translate"} & {*modules.split()}


def test_without_the_planner_it_is_said_how_to_install_it(
    gripping: Checked, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "up_fast_downward", None)
    with pytest.raises(planner.NoPlannerError, match=r"pip install 'ezskiros\[plan\]'"):
        planned(gripping, "(contain shelf starter)")


def test_a_plan_that_the_world_model_denies_is_not_given(
    gripping: Checked, monkeypatch: pytest.MonkeyPatch
) -> None:
    def half(problem: Problem, seconds: float) -> list[PlanStep]:
        return (real(problem, seconds) or [])[-1:]

    real = planner.solve
    monkeypatch.setattr("ezskiros.planning.search.solve", half)
    plan, said = planned(gripping, "(contain shelf starter)")
    assert plan is None
    assert [each.code for each in said] == ["EZS858"]


def test_steps_that_need_not_be_are_left_out(
    gripping: Checked, monkeypatch: pytest.MonkeyPatch
) -> None:
    def with_detour(problem: Problem, seconds: float) -> list[PlanStep]:
        steps = real(problem, seconds)
        assert steps is not None
        (approach,) = (each for each in problem.actions if each.skill.name == "Approach")
        there = {
            "Gripper": steps[0].individuals["Gripper"],
            "Target": "http://rvmi.aau.dk/ontologies/skiros.owl#Location-1",
        }
        back = {**there, "Target": "http://rvmi.aau.dk/ontologies/skiros.owl#Location-2"}
        return [PlanStep(approach, there), PlanStep(approach, back), *steps]

    short = names(planned(gripping, "(contain shelf starter)")[0])
    real = planner.solve
    monkeypatch.setattr("ezskiros.planning.search.solve", with_detour)
    assert names(planned(gripping, "(contain shelf starter)")[0]) == short


# --- as a skill -----------------------------------------------------------------------------------


def written(gripping: Checked) -> str:
    plan, _ = planned(gripping, "(contain shelf starter)")
    assert isinstance(plan, Plan)
    return source(plan, "tidy_up", "(contain shelf starter)")


def test_a_plan_as_a_skill(gripping: Checked, bless: bool) -> None:
    assert_golden(GOLDEN / "tidy_up.txt", written(gripping), bless=bless)


def run(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    named = [] if "--ontology" in arguments else ["--ontology", str(HALL)]
    return command_line.run("ezskiros", *arguments, *named, folder=folder)


@pytest.fixture
def lab(tmp_path: Path) -> Path:
    for each in TREES.iterdir():
        if each.is_file():
            (tmp_path / each.name).write_text(each.read_text("utf-8"), encoding="utf-8")
    return tmp_path


GOAL = ("--scene", "lab.turtle", "--goal", "(skiros:contain shelf starter)")


def test_what_is_written_is_checked(lab: Path) -> None:
    done = run("plan", *GOAL, "--out", "tidy_up.py", folder=lab)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.endswith("\n3 warnings in 2 files\n")
    shown = run("show", "tidy_up", folder=lab)
    assert re.search(r"serialstar\n.*Fetch", shown.stdout)


def test_who_plans_writes_nothing_beside_the_skills(lab: Path) -> None:
    """Two that plan in one folder would read each other's problem."""
    (lab / "output.sas").mkdir()
    done = run("plan", *GOAL, folder=lab)
    assert (done.returncode, done.stderr) == (0, "")


def test_an_ontology_that_is_not_there_is_reported(tmp_path: Path) -> None:
    (tmp_path / "lab.turtle").write_text((TREES / "lab.turtle").read_text("utf-8"), "utf-8")
    done = run("plan", *GOAL, "--ontology", "nowhere", folder=tmp_path)
    assert done.returncode == 2
    assert "'nowhere' does not exist" in done.stderr


def test_a_file_from_which_the_skills_cannot_be_imported(lab: Path) -> None:
    (lab / "other").mkdir()
    done = run("plan", *GOAL, "--out", "other/tidy_up.py", folder=lab)
    assert done.returncode == 2
    assert f"cannot import the skills: write it to {lab}" in done.stderr


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--out", "tidy-up.py"), "is not the file name of a Python module"),
        (("--scene", "nowhere.turtle"), "there is no file nowhere.turtle"),
    ],
)
def test_wrong_calls(lab: Path, arguments: tuple[str, ...], said: str) -> None:
    done = run("plan", *GOAL, *arguments, folder=lab)
    assert done.returncode == 2
    assert said in done.stdout + done.stderr


def test_a_plan_leaves_the_choice_of_an_implementation_to_the_run(tmp_path: Path) -> None:
    """One implementation can do it where the product has a weight, one where the robot is near."""
    move = skill(
        "Move",
        "Robot: cora.Robot, Object: skiros.Product, Target: skiros.Location",
        "post Target.contain(Object)",
    )
    own = (
        "    def conditions(self, Object):\n"
        "        self.pre_conditions += Object.Weight == 2.0\n"
        "class carry(Move.SkillBase):\n"
        "    def conditions(self, Robot, Target):\n"
        "        self.pre_conditions += Robot.at(Target)\n"
        "    def execute(self):\n"
    )
    skills = DRIVE + move.replace("    def execute(self):\n", own)
    found, scene = world(tmp_path, ROBOT, skills)
    for individual, steps in (("Product-4", ["Move"]), ("Product-5", ["Drive", "Move"])):
        plan, said = planned(found, f"(contain skiros:Location-3 skiros:{individual})", scene)
        assert names(plan) == steps, said
        assert plan is not None
        assert "            Move(" in source(plan, "moving", "a goal")
