"""Deadlines of the steps of trees that rules run, against the time that the rules give."""

from __future__ import annotations

from pathlib import Path

import pytest

from dslkit.diagnostics import Diagnostic
from support.robots import found_with, put_example

STEPS = """
from ezskiros import SkillDescription


class Wait(SkillDescription):
    def description(self, Seconds: float = 3.0):
        pass


class wait(Wait.SkillBase):
    def execute(self):
        return self.success("waited")


class Look(SkillDescription):
    def description(self):
        pass


class look(Look.SkillBase):
    def execute(self):
        return self.success("seen")
"""
COMPOUND = """

class {name}(SkillDescription):
    def description(self, Patience: float = 5.0, Tries: int = 2):
        pass


class {base}({name}.SkillBase):
    def expandBT(self, params):
        {body}
"""
BODIES = {
    "NoneTimed": "self.serialstar(Wait(), Look())",
    "OneTimed": "self.serialstar(self.timeout(Wait(), 4.0), Look())",
    "AllTimed": "self.serialstar(self.timeout(Wait(), 4.0), self.timeout(Look(), 2.5))",
    "TimedTogether": "self.timeout(self.serialstar(Wait(), Look()), 7.0)",
    "Beside": "self.parallelff(self.timeout(Wait(), 4.0), self.timeout(Look(), 2.5))",
    "Again": "self.retry(self.timeout(Wait(), 4.0), 3)",
    "AgainByParameter": "self.retry(self.timeout(Wait(), params.Patience), params.Tries)",
    "Computed": "self.timeout(Wait(), params.Patience * 2)",
    "OneWay": "Wait() if params.Patience > 3.0 else Look()",
    "Nested": "self.serialstar(AllTimed(), TimedTogether())",
    "NestedOpen": "self.serialstar(OneTimed(), self.timeout(Look(), 1.0))",
    "NestedOpenTwice": "self.serialstar(OneTimed(), OneWay())",
    "Passed": "self.serialstar(AgainByParameter(Patience=params.Patience, Tries=4))",
    "Written": "self.serialstar(AgainByParameter(Patience=1.5, Tries=1))",
    "Timed": "self.timeout(NoneTimed(), 6.0)",
}
RULES = """
skills "skills.json";
input gap = topic /gap : std_msgs/Float64 in m timeout 0.5 sec;
action halt {{ block /cmd_vel : geometry_msgs/Twist; }}
action away {{ tree {tree} within {within} else halt; }}
rule near: if gap < 0.3 m then {{ away; }} clear for 1 sec;
"""


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    text = STEPS
    for name, body in BODIES.items():
        text += COMPOUND.format(name=name, base=f"made_{name.lower()}", body=body)
    return put_example(tmp_path_factory.mktemp("robot"), {"recovering.py": text})


def found(robot: Path, tree: str, within: str) -> list[Diagnostic]:
    reported = found_with(robot, RULES.format(tree=tree, within=within))
    assert "CHK206" not in [each.code for each in reported]
    return [each for each in reported if each.code in ("CHK209", "CHK210")]


@pytest.mark.parametrize(
    ("tree", "steps"),
    [
        ("Wait", []),  # the rule bounds it
        ("NoneTimed", ["Wait()", "Look()"]),
        ("OneTimed", []),
        ("AllTimed", []),
        ("TimedTogether", []),
        ("Timed", []),
        ("Computed", []),
        ("OneWay", []),  # one or the other
        ("NestedOpen", []),
        ("NestedOpenTwice", ["Look()", "Wait()", "Look()"]),
    ],
)
def test_steps_that_only_the_rule_bounds(robot: Path, tree: str, steps: list[str]) -> None:
    reported = found(robot, tree, "90 sec")
    assert {each.code for each in reported} <= {"CHK209"}
    assert [each.primary.span.text for each in reported] == steps
    assert all("it can use all 90 s that `near` allows" in each.title for each in reported)


@pytest.mark.parametrize(
    ("tree", "longest"),
    [
        ("AllTimed", 6.5),
        ("TimedTogether", 7),
        ("Beside", 4),
        ("Again", 12),
        ("AgainByParameter", 10),
        ("AgainByParameter(Patience: 4.0, Tries: 3)", 12),
        ("Nested", 13.5),
        ("Passed", 20),
        ("Passed(Patience: 3.0)", 12),
        ("Written", 1.5),
        ("Timed", 6),
    ],
)
def test_deadlines_that_add_up(robot: Path, tree: str, longest: float) -> None:
    assert found(robot, tree, f"{longest} sec") == []
    (reported,) = found(robot, tree, f"{longest - 0.1} sec")
    name = tree.partition("(")[0]
    assert reported.code == "CHK210"
    assert reported.title.startswith(
        f"the deadlines in `{name}` add up to {longest:g} s, but `near` allows "
    )


@pytest.mark.parametrize(
    "tree",
    [
        "Wait",
        "OneTimed",
        "NestedOpen",
        "Computed",
        "AgainByParameter(Patience: doing Wait.Seconds)",
    ],
)
def test_nothing_is_said_of_what_is_not_known(robot: Path, tree: str) -> None:
    assert found(robot, tree, "0.1 sec") == []


def test_the_parts_that_add_up_are_reported(robot: Path) -> None:
    (reported,) = found(robot, "Nested", "13 sec")
    assert reported.notes == ("13.5 s = 4 s (`Wait`) + 2.5 s (`Look`) + 7 s (`Wait` and `Look`)",)
    (reported,) = found(robot, "Again", "10 sec")
    assert reported.notes == ("12 s = 12 s (3 x `Wait`)",)
