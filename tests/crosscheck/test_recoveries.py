"""Trees that rules run, and what the same rules take away from them meanwhile."""

from __future__ import annotations

from pathlib import Path

import pytest

from crosscheck.recovery_errors import NoDeadline, TreeHindered
from dslkit.diagnostics import Severity
from support.robots import found_with, put_example

RULES = """
skills "skills.json";
input gap = topic /gap : std_msgs/Float64 in m timeout 0.5 sec;
action halt { block /cmd_vel : geometry_msgs/Twist; }
action slow { limit /cmd_vel : geometry_msgs/Twist { linear.x in [-0.1, 0.1] m/s; }; }
action back { publish /cmd_vel : geometry_msgs/Twist { linear.x = -0.1 m/s; } at 10 Hz; }
action still { cancel /move_base within 0.5 sec else halt; }
action away { tree Drive(Robot: doing Drive.Robot, Target: "desk") within 20 sec else halt; }
action anew {
    tree Erase(Robot: doing Erase.Robot, Gripper: doing Erase.Gripper, Board: "whiteboard")
        within 2 min then retry else halt;
}
rule near: if gap < 0.3 m then { ACTIONS } clear for 1 sec;
"""


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return put_example(tmp_path_factory.mktemp("robot"))


@pytest.mark.parametrize(
    ("actions", "taken"),
    [
        ("halt; away;", ["/cmd_vel"]),
        ("away; also halt;", ["/cmd_vel"]),
        ("back; away;", ["/cmd_vel"]),
        ("still; away;", ["/move_base"]),
        ("still; halt; away;", ["/cmd_vel", "/move_base"]),
        ("halt; anew;", ["/cmd_vel"]),  # of a skill in its tree
        ("away; halt;", []),
        ("slow; away;", []),
        ("away;", []),
    ],
)
def test_a_tree_is_not_hindered_by_its_own_rule(
    robot: Path, actions: str, taken: list[str]
) -> None:
    found = found_with(robot, RULES.replace("ACTIONS", actions))
    hindered = [each for each in found if each.severity is Severity.ERROR]
    assert {each.code for each in hindered} <= {TreeHindered.code}, hindered
    assert sorted(each.title.split(" takes ")[1].split()[0] for each in hindered) == taken
    assert all("` runs `" in each.title for each in hindered)


def test_another_rule_may_take_what_it_needs(robot: Path) -> None:
    """They need not be active together; what happens then is for their priority to say."""
    rules = RULES.replace("ACTIONS", "away;") + "rule far: if gap > 9 m then { halt; };\n"
    assert TreeHindered.code not in [each.code for each in found_with(robot, rules)]


# --- conditions ----------------------------------------------------------------------------------

MODULES = {
    "recovering.py": '''
from ezskiros import INFERRED, SkillDescription
from .world import cora, office, rparts, skiros


class Drop(SkillDescription):
    """Lets go of a sponge."""

    def description(self, Gripper: rparts.GripperEffector, Sponge: office.Sponge):
        self.pre_conditions += Gripper.contain(Sponge)
        self.post_conditions += ~Gripper.contain(Sponge)


class Take(SkillDescription):
    """Takes a sponge."""

    def description(self, Gripper: rparts.GripperEffector, Sponge: office.Sponge):
        self.pre_conditions += ~Gripper.contain(Sponge)
        self.post_conditions += Gripper.contain(Sponge)


class Rub(SkillDescription):
    """Holds a sponge all the while."""

    def description(self, Gripper: rparts.GripperEffector, Sponge: office.Sponge):
        self.hold_conditions += Gripper.contain(Sponge)


class Again(SkillDescription):
    """Drops a sponge, and takes it up again."""

    def description(self, Gripper: rparts.GripperEffector, Sponge: office.Sponge):
        self.pre_conditions += Gripper.contain(Sponge)
        self.post_conditions += Gripper.contain(Sponge)


class again(Again.SkillBase):
    def expandBT(self, params):
        self.serialstar(
            Drop(Gripper=params.Gripper, Sponge=params.Sponge),
            Take(Gripper=params.Gripper, Sponge=params.Sponge),
        )


class Carry(SkillDescription):
    """Needs the sponge at its start only."""

    def description(self, Gripper: rparts.GripperEffector, Sponge: office.Sponge):
        self.pre_conditions += Gripper.contain(Sponge)


class carry(Carry.SkillBase):
    def expandBT(self, params):
        self.serialstar(
            Rub(Gripper=params.Gripper, Sponge=params.Sponge),
            Drop(Gripper=params.Gripper, Sponge=params.Sponge),
        )
''',
}
HEAD = """
skills "skills.json";
input gap = topic /gap : std_msgs/Float64 in m timeout 0.5 sec;
action halt { block /cmd_vel : geometry_msgs/Twist; }
"""


@pytest.fixture(scope="module")
def recovering(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return put_example(tmp_path_factory.mktemp("recovering"), MODULES)


def passed(skill: str) -> str:
    return f"Gripper: doing {skill}.Gripper, Sponge: doing {skill}.Sponge"


def codes_of(
    robot: Path, tree: str, condition: str, then: str = "replan", clear: str = "when doing Rub"
) -> list[str]:
    rules = f"""{HEAD}
action recover {{ tree {tree} within 20 sec then {then} else halt; }}
rule near: if gap < 0.3 m and ({condition}) then {{ recover; }} clear {clear};
"""
    return sorted({each.code for each in found_with(robot, rules)} - {NoDeadline.code})


@pytest.mark.parametrize(
    ("tree", "running", "expected"),
    [
        (f"Drop({passed('Rub')})", "doing Rub", []),  # it is held
        (f"Drop({passed('Wipe')})", "doing Wipe", []),  # a primitive still has what it needed
        (f"Drop({passed('Rub')})", "doing Rub or doing Wipe", ["CHK208", "CHK212"]),
        (f"Drop({passed('Carry')})", "doing Carry", ["CHK208"]),  # it may have dropped it
        (
            f"Drop({passed('Carry')})",
            "doing Carry and doing Rub",
            ["CHK208"],
        ),  # of other individuals
        (f"Take({passed('Rub')})", "doing Rub", ["CHK207"]),
        (f"Take({passed('Wipe')})", "doing Wipe", ["CHK207"]),
        (f"Take({passed('Drive')})".replace("Drive", "Rub"), "not doing Rub", ["CHK208", "CHK212"]),
        ('Drop(Gripper: "left", Sponge: "sponge")', "doing Rub", ["CHK208"]),
        ('Drive(Robot: "robot", Target: "desk")', "doing Rub", []),  # its start is looked for
    ],
)
def test_the_conditions_of_a_tree_are_those_of_skills_that_run(
    recovering: Path, tree: str, running: str, expected: list[str]
) -> None:
    assert codes_of(recovering, tree, running) == expected


@pytest.mark.parametrize(
    ("tree", "running", "then", "expected"),
    [
        (f"Drop({passed('Rub')})", "doing Rub", "resume", ["CHK211"]),
        (f"Drop({passed('Rub')})", "doing Rub", "retry", ["CHK211"]),  # of `Carry`
        (f"Drop({passed('Rub')})", "doing Rub", "replan", []),
        (f"Again({passed('Rub')})", "doing Rub", "resume", []),  # it restores what it ends
        (f"Again({passed('Wipe')})", "doing Wipe", "resume", []),
        ('Drive(Robot: "robot", Target: "desk")', "doing Rub", "resume", []),
        (
            'Drive(Robot: "robot", Target: "desk")',
            "doing Wipe",
            "retry",
            [],
        ),  # the start is looked for anew
    ],
)
def test_a_skill_that_a_tree_interrupts_can_start_again(
    recovering: Path, tree: str, running: str, then: str, expected: list[str]
) -> None:
    assert codes_of(recovering, tree, running, then) == expected


@pytest.mark.parametrize(
    ("tree", "running", "clear", "expected"),
    [
        (f"Drop({passed('Rub')})", "doing Rub", "for 1 sec", ["CHK214"]),
        (f"Drop({passed('Rub')})", "doing Rub", "when gap > 1 m", []),
        (f"Carry({passed('Rub')})", "doing Rub", "for 1 sec", []),  # the tree has it too
        (f"Drop({passed('Carry')})", "doing Carry", "for 1 sec", ["CHK208"]),  # it still runs
    ],
)
def test_a_rule_does_not_end_its_own_tree(
    recovering: Path, tree: str, running: str, clear: str, expected: list[str]
) -> None:
    assert codes_of(recovering, tree, running, clear=clear) == expected


def test_what_ends_a_condition_is_shown(recovering: Path) -> None:
    rules = f"""{HEAD}
action recover {{ tree Drop({passed("Rub")}) within 20 sec then resume else halt; }}
rule near: if gap < 0.3 m and doing Rub then {{ recover; }} clear when doing Rub;
"""
    (found,) = found_with(recovering, rules)
    assert found.title == (
        "after `Drop`, `Rub` may not restart: `Gripper.contain(Sponge)` need not hold"
    )
    assert [label.text for label in found.labels] == [
        "`Rub` needs this",
        "`Drop` may end this condition",
    ]
    assert [label.span.text for label in found.labels] == [
        "Gripper.contain(Sponge)",
        "~Gripper.contain(Sponge)",
    ]


@pytest.mark.parametrize(
    ("old", "new", "reported"),
    [
        ('"kind": "relation"', '"kind": "relative"', "its `kind` is not one of"),
        ('"is_true": true', '"is_true": 1', "its `is_true` is missing or has the wrong type"),
    ],
)
def test_a_condition_that_is_none_is_said(
    recovering: Path, old: str, new: str, reported: str
) -> None:
    skills = recovering / "skills.json"
    kept = skills.read_text()
    assert old in kept
    try:
        skills.write_text(kept.replace(old, new))
        rules = f"""{HEAD}
action recover {{ tree Drop({passed("Rub")}) within 20 sec then replan else halt; }}
rule near: if gap < 0.3 m and doing Rub then {{ recover; }} clear when doing Rub;
"""
        (found,) = found_with(recovering, rules)
    finally:
        skills.write_text(kept)
    assert found.code == "CHK213"
    assert reported in found.title
