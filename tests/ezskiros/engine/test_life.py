"""The life of a skill: start, ticks, end, preemption, and what goes wrong on the way."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from ezskiros.engine.events import Happened
from ezskiros.engine.task import PERIOD
from support.engine import Skills

SCENE = """
rparts:GripperEffector-1 a rparts:GripperEffector ; skiros:at skiros:TransformationPose-2 .
skiros:TransformationPose-2 a skiros:TransformationPose .
skiros:TransformationPose-3 a skiros:TransformationPose .
"""
MOVE = """
class Move(SkillDescription):
    def description(
        self, Gripper: rparts.GripperEffector, Start: INFERRED[skiros.TransformationPose],
        Goal: skiros.TransformationPose,
    ):
        self.pre_conditions += Gripper.at(Start)
        self.hold_conditions += ~Gripper.contain(Goal)
        self.post_conditions += Gripper.at(Goal)


class move(Move.SkillBase):
    def onStart(self):
        self.left = 2
        return True

    def execute(self):
        if self.left == 0:
            self.world.relate(self.params.Gripper, skiros.at, self.params.Goal)
            return self.success("there")
        self.left -= 1
        return self.step("on the way")
"""
GIVEN = ("Gripper=rparts:GripperEffector-1", "Goal=skiros:TransformationPose-3")


def skills(tmp_path: Path, source: str, scene: str = SCENE, **options: object) -> Skills:
    return Skills(tmp_path, source, scene, options)


def primitive(body: str) -> str:
    """A skill `Act` whose implementation is written in the lines of `body`."""
    lines = "\n".join(f"    {line}" for line in body.splitlines())
    return (
        "class Act(SkillDescription):\n"
        "    def description(self, Gripper: OPTIONAL[rparts.GripperEffector]): pass\n"
        f"class act(Act.SkillBase):\n{lines}\n"
    )


def test_a_skill_that_succeeds(tmp_path: Path) -> None:
    ran = skills(tmp_path, MOVE).run("Move", *GIVEN)
    assert ran.outcome.is_success
    assert [(each.happened, each.code, each.text) for each in ran.events] == [
        (Happened.STARTED, 0, "Start"),
        (Happened.RUNNING, 1, "on the way"),
        (Happened.SUCCEEDED, 3, "there"),
    ]
    assert ran.outcome.ticks == 3
    assert ran.outcome.seconds == pytest.approx(2 * PERIOD)


def test_a_pre_condition_that_does_not_hold(tmp_path: Path) -> None:
    scene = SCENE.replace("skiros:at skiros:TransformationPose-2", 'rdfs:label "g"')
    ran = skills(tmp_path, MOVE, scene).run("Move", *GIVEN)
    assert not ran.outcome.is_success
    assert ran.events[-1].code == -1
    assert ran.reason.startswith("pre-condition does not hold: Gripper.at(Start) (")
    assert "/skills.py:15:32): " in ran.reason
    assert ran.reason.endswith(
        "Gripper is rparts:GripperEffector-1; Start has no value; Gripper skiros:at nothing"
    )


def test_a_hold_condition_is_asked_at_every_tick(tmp_path: Path) -> None:
    source = MOVE.replace(
        "        self.left -= 1\n",
        "        self.left -= 1\n"
        "        self.world.relate(self.params.Gripper, 'skiros:contain', self.params.Goal)\n",
    ) + (
        "    def onPreempt(self):\n        self.was_preempted = True\n"
        "        return self.success('gladly')\n"
        "    def onEnd(self):\n"
        "        self.world.set_value(self.params.Gripper, skiros.Weight, 1.0)\n"
        "        return self.was_preempted\n"
    )
    ran = skills(tmp_path, source).run("Move", *GIVEN)
    assert (ran.outcome.is_success, ran.outcome.ticks, ran.events[-1].code) == (False, 2, -2)
    assert "hold-condition is broken: ~Gripper.contain(Goal)" in ran.reason
    weight = "http://rvmi.aau.dk/ontologies/skiros.owl#Weight"
    gripper = ran.world.named("rparts:GripperEffector-1")[0]
    assert ran.world.values(gripper, weight) == [1.0]


def test_skiros2_asks_no_hold_condition_of_a_primitive(tmp_path: Path) -> None:
    source = MOVE.replace(
        "        self.left -= 1\n",
        "        self.left -= 1\n"
        "        self.world.relate(self.params.Gripper, 'skiros:contain', self.params.Goal)\n",
    )
    assert skills(tmp_path, source, compatible=True).run("Move", *GIVEN).outcome.is_success


def test_a_post_condition_that_does_not_hold(tmp_path: Path) -> None:
    ran = skills(tmp_path, MOVE.replace("self.world.relate", "print")).run("Move", *GIVEN)
    assert ran.reason.startswith("post-condition does not hold: Gripper.at(Goal) (")
    assert ran.reason.endswith(
        "Gripper is rparts:GripperEffector-1; Goal is skiros:TransformationPose-3; "
        "Gripper skiros:at skiros:TransformationPose-2"
    )


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("def execute(self):\n    return 1 / self.zero()\ndef zero(self):\n    return 0",
         "`execute` raised ZeroDivisionError: division by zero (skills.py:"),
        ("def execute(self):\n    raise SystemExit(3)", "`execute` raised SystemExit: 3 ("),
        ("def execute(self):\n    import os\n    os._exit(0)\n    return self.success()",
         "`execute` raised ProcessEndError: os._exit(0) (skills.py:"),
        ("def execute(self):\n    import os\n    if os.fork():\n        os._exit(0)\n"
         "    os._exit(1)\n    return self.success()",
         "`execute` raised ProcessEndError: os._exit(0) (skills.py:"),
        ("def execute(self):\n    return bool([1])",
         "`execute` returned True, not a result of self.success, self.step or self.fail ("),
        ("def execute(self):\n    x = []\n    return x.append(1)", "`execute` returned nothing"),
        ("def execute(self):\n    return getattr(self.params, 'Speed')",
         "`Act` has no parameter `Speed`"),
        ("def onStart(self):\n    return bool([])\ndef execute(self):\n    return self.success()",
         "`onStart` reported a failure (skills.py:"),
        ("def onStart(self):\n    raise KeyError('arm')\n"
         "def execute(self):\n    return self.success()",
         "`onStart` raised KeyError: there is no 'arm'"),
        ("def onEnd(self):\n    return bool([])\ndef execute(self):\n    return self.success()",
         "`onEnd` reported a failure"),
        ("def execute(self):\n    return self.fail('no arm', 7)", "no arm"),
        ("def __init__(self):\n    raise OSError('no bus')\n"
         "def execute(self):\n    return self.success()", "`__init__` raised OSError: no bus"),
        ("def execute(self):\n    return self.execute()",
         "`execute` raised RecursionError: it calls itself endlessly"),
    ],
)  # fmt: skip
def test_mistakes_of_primitives_are_failures(tmp_path: Path, body: str, said: str) -> None:
    ran = skills(tmp_path, primitive(body)).run("Act")
    assert not ran.outcome.is_success
    assert said in re.sub(r"\(/\S*/", "(", ran.reason)


def test_codes_of_failures_are_negative_as_in_skiros2(tmp_path: Path) -> None:
    body = "def execute(self):\n    return self.fail('no arm', 7)"
    assert skills(tmp_path, primitive(body)).run("Act").events[-1].code == -7
    body = "def execute(self):\n    raise ValueError"
    assert skills(tmp_path, primitive(body)).run("Act").events[-1].code == -405
    body = "def onStart(self):\n    raise ValueError\ndef execute(self):\n    return self.success()"
    assert skills(tmp_path, primitive(body)).run("Act").events[-1].code == -404


def test_on_end_is_called_after_a_mistake(tmp_path: Path) -> None:
    body = (
        "def execute(self):\n    raise ValueError\n"
        "def onEnd(self):\n    self.world.new(skiros.Product)\n    return True"
    )
    ran = skills(tmp_path, primitive(body)).run("Act")
    assert ran.world.named("skiros:Product-4")


TREE = """
class Note(SkillDescription):
    def description(self, Name: str, Ticks: int = 100):
        pass


class note(Note.SkillBase):
    log = []

    def onStart(self):
        self.count = 0
        return True

    def execute(self):
        self.count += 1
        done = self.count > self.params.Ticks
        return self.success(self.params.Name) if done else self.step(self.params.Name)

    def onPreempt(self):
        self.log.append(f"{self.params.Name} preempted")
        return self.fail("stopped")

    def onEnd(self):
        self.log.append(f"{self.params.Name} ended")
        return True


class Both(SkillDescription):
    def description(self):
        pass


class both(Both.SkillBase):
    def expandBT(self, params):
        self.parallelff(Note(Name="a"), self.serial(Note(Name="b")))

    def onPreempt(self):
        note.log.append("both preempted")
        return self.fail("stopped")

    def onEnd(self):
        note.log.append("both ended")
        return True


class Outer(SkillDescription):
    def description(self):
        pass


class outer(Outer.SkillBase):
    def expandBT(self, params):
        self.selector(self.timeout(Both(), 0.2), Note(Name="c", Ticks=0))
"""


def test_preemption_is_of_children_first(tmp_path: Path) -> None:
    task, events, _ = skills(tmp_path, TREE, "").task("Outer")
    task.tick()
    task.preempt()
    log = task.root.tree.children[0].decorated.tree.children[0]._instance.log  # type: ignore[union-attr]
    children = ["a preempted", "a ended", "b preempted", "b ended"]
    assert log == [*children, "both preempted", "both ended"]
    ended = [each.path[-1] for each in events if each.happened is Happened.PREEMPTED]
    assert ended == ["Note", "Note#2", "Both", "outer"]


def test_a_timeout_preempts_and_fails_by_the_clock_of_the_task(tmp_path: Path) -> None:
    ran = skills(tmp_path, TREE, "").run("Outer")
    assert ran.outcome.is_success
    assert ran.ends() == [
        "Note preempted", "Note#2 preempted", "Both preempted", "Note succeeded",
        "outer succeeded",
    ]  # fmt: skip
    assert ran.outcome.seconds == pytest.approx(0.2)


def test_the_reason_of_a_timeout(tmp_path: Path) -> None:
    source = TREE.replace("self.selector(", "self.serial(")
    reason = skills(tmp_path, source, "").run("Outer").reason
    assert reason.startswith("no result within 0.2 s (")


FLAKY = """
class Try(SkillDescription):
    def description(self):
        pass


class attempt(Try.SkillBase):
    tries = 0

    def execute(self):
        type(self).tries += 1
        return self.success("at last") if self.tries == 3 else self.fail(f"try {self.tries}")


class Whole(SkillDescription):
    def description(self):
        pass


class whole(Whole.SkillBase):
    def expandBT(self, params):
        self.retry(Try(), 3)


class Not(SkillDescription):
    def description(self):
        pass


class invert(Not.SkillBase):
    def expandBT(self, params):
        self.inverter(Try())
"""


def test_retry_is_given_up_after_its_count(tmp_path: Path) -> None:
    ran = skills(tmp_path, FLAKY, "").run("Whole")
    assert ran.outcome.is_success
    assert ran.ends() == ["Try failed", "Try failed", "Try succeeded", "whole succeeded"]
    ran = skills(tmp_path, FLAKY.replace("(), 3)", "(), 2)"), "").run("Whole")
    assert (ran.outcome.is_success, ran.reason) == (False, "try 2")


LIMITED = (
    FLAKY
    + """
class Wide(SkillDescription):
    def description(self, Count: int, Factor: int = 1, Seconds: float = 9.0):
        pass


class wide(Wide.SkillBase):
    def expandBT(self, params):
        self.timeout(self.retry(Try(), params.Count * params.Factor), params.Seconds)


class OnlyCount(SkillDescription):
    def description(self, Count: int):
        pass


class only(OnlyCount.SkillBase):
    def expandBT(self, params):
        self.retry(Try(), params.Count)
"""
)


@pytest.mark.parametrize(
    ("skill", "values", "is_success"),
    [
        ("Wide", "Count=3", True),
        ("Wide", "Count=2", False),
        ("Wide", "Count=2 Factor=2", True),
        ("OnlyCount", "Count=3", True),
        ("OnlyCount", "Count=2", False),
    ],
)
def test_limits_are_parameters(skill: str, values: str, is_success: bool, tmp_path: Path) -> None:
    ran = skills(tmp_path, LIMITED, "").run(skill, *values.split())
    assert ran.outcome.is_success is is_success


def test_a_limit_that_turns_out_to_be_none_is_a_failure_to_start(tmp_path: Path) -> None:
    ran = skills(tmp_path, LIMITED, "").run("OnlyCount", "Count=0")
    assert not ran.outcome.is_success
    assert "retry needs a whole number above 0, not 0" in ran.reason


def test_an_inverter_turns_results(tmp_path: Path) -> None:
    assert skills(tmp_path, FLAKY, "").run("Not").outcome.is_success
    ran = skills(tmp_path, FLAKY.replace("== 3", "== 1"), "").run("Not")
    assert ran.reason.startswith("the inverted child has succeeded (")


def test_a_tree_that_runs_forever_is_stopped(tmp_path: Path) -> None:
    ran = skills(tmp_path, TREE, "").run("Both", most_ticks=5)
    assert (ran.outcome.ticks, ran.reason) == (5, "too many ticks")


def test_a_skill_that_calls_itself_is_a_failure(tmp_path: Path) -> None:
    source = TREE + (
        "class Endless(SkillDescription):\n    def description(self, Count: int = 1): pass\n"
        "class endless(Endless.SkillBase):\n"
        "    def expandBT(self, params):\n"
        "        if params.Count > 0:\n            self.serial(Endless(Count=params.Count))\n"
        "        else:\n            Note(Name='a')\n"
    )
    reason = skills(tmp_path, source, "").run("Endless").reason
    assert reason == "the tree has more than 2000 levels: does a skill call itself?"


def test_a_tree_of_a_thousand_levels_runs(tmp_path: Path) -> None:
    source = TREE + (
        "class Deep(SkillDescription):\n    def description(self): pass\n"
        "class deep(Deep.SkillBase):\n"
        "    def expandBT(self, params):\n"
        "        node = Note(Name='a', Ticks=2)\n"
        "        for _ in range(500):\n            node = self.serialstar(self.nofail(node))\n"
    )
    ran = skills(tmp_path, source, "").run("Deep")
    assert (ran.outcome.is_success, ran.outcome.ticks) == (True, 3)
