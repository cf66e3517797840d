"""Trees that rules run, and what the same rules take away from them meanwhile."""

from __future__ import annotations

from pathlib import Path

import pytest

from crosscheck.errors import TreeHindered
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
    assert all("which it runs" in each.title for each in hindered)


def test_another_rule_may_take_what_it_needs(robot: Path) -> None:
    """They need not be active together; what happens then is for their priority to say."""
    rules = RULES.replace("ACTIONS", "away;") + "rule far: if gap > 9 m then { halt; };\n"
    assert TreeHindered.code not in [each.code for each in found_with(robot, rules)]
