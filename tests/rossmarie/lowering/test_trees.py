"""A behavior tree that a rule runs is a goal: which skill, with which values, and what then."""

from __future__ import annotations

import pytest

from rossmarie.ir import reactions
from support.compiled import machine_of
from support.rule_skills import DIGEST, FILE

HEAD = f"""
skills "{FILE}";
input gap = topic /gap : std_msgs/Float64 in m timeout 0.5 sec;
const slowly = 0.3
action halt {{ block /cmd_vel : geometry_msgs/Twist; }}
rule near: if gap < 0.3 m then {{ away; }};
"""


@pytest.mark.parametrize(
    ("tree", "skill", "arguments", "afterwards"),
    [
        ("Move(Speed: slowly) within 20 sec", "Move", ("Speed=0.3",), "resume"),
        ("Move(Speed: 2 * slowly) within 20 sec then resume", "Move", ("Speed=0.6",), "resume"),
        (
            "Drive(Target: doing Drive.Target, Speed: doing Move.Speed) within 20 sec then retry",
            "Drive",
            ("Speed=@Move.Speed", "Target=@Drive.Target"),
            "retry",
        ),
        (
            'Push(Object: "box", Force: 2, Gently: true, Mode: "slow") within 20 sec then replan',
            "Push",
            ("Force=2.0", "Gently=true", "Mode=slow", "Object=box"),
            "replan",
        ),
        (
            'Push(Object: "box", Force: 2, Mode: "slow") within 20 sec',  # the other has a default
            "Push",
            ("Force=2.0", "Mode=slow", "Object=box"),
            "resume",
        ),
    ],
)
def test_a_tree_is_a_goal_for_whoever_runs_skills(
    tree: str, skill: str, arguments: tuple[str, ...], afterwards: str
) -> None:
    machine = machine_of(f"{HEAD}action away {{ tree {tree} else halt; }}\n")
    goals = [
        task.effect
        for task in machine.reactions.tasks
        if isinstance(task.effect, reactions.SendGoal)
    ]
    (goal,) = goals
    assert (goal.server, goal.action_type) == ("/recovery", "skill_context_msgs/Recover")
    assert goal.timeout_ns == 20_000_000_000
    assert {each.path[0]: each.value for each in goal.assignments} == {
        "digest": DIGEST,
        "skill": skill,
        "arguments": arguments,
        "afterwards": afterwards,
        **({"without": ()} if afterwards == "replan" else {}),
    }
