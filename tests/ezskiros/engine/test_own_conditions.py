"""The choice of an implementation for a child that names none. tests/ezskiros/hosts runs the same
cases in SkiROS2.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.engine.events import Happened
from support.engine import Ran, Skills
from support.own_conditions import SCENE, TREES, skills

CHOOSING = "Move(Object=params.One)"


def reported(ran: Ran) -> list[str]:
    """The texts that primitives have said at their ends."""
    ended = [each for each in ran.events if each.happened is Happened.SUCCEEDED]
    return [each.text for each in ended if each.text != "End"]


@pytest.mark.parametrize(("one", "tree", "expected"), TREES)
def test_the_implementation_whose_conditions_hold_is_taken(
    tmp_path: Path, one: str, tree: str, expected: list[str] | str
) -> None:
    ran = Skills(tmp_path, skills(tree), SCENE).run("Task", f"One={one}", "Object=feather")
    if isinstance(expected, str):
        assert not ran.outcome.is_success
        assert f"pre-condition does not hold: {expected} (" in ran.reason
    else:
        assert reported(ran) == expected
        assert ran.outcome.is_success or "inverter" in tree


@pytest.mark.parametrize(("one", "expected"), [("nut", ["lifted nut"]), ("bolt", [])])
def test_compatible_runs_try_the_first_only(tmp_path: Path, one: str, expected: list[str]) -> None:
    library = Skills(tmp_path, skills(CHOOSING), SCENE, {"compatible": True})
    assert reported(library.run("Task", f"One={one}", "Object=feather")) == expected


def test_without_one_that_can_start_each_tells_why(tmp_path: Path) -> None:
    source = skills(CHOOSING).replace("~Object.Weight\n", "Object.Weight == 7.0\n")
    ran = Skills(tmp_path, source, SCENE).run("Task", "One=feather", "Object=nut")
    assert ran.reason.startswith("no implementation can start: `lift`: pre-condition does not hold")
    assert "; `push`: pre-condition" in ran.reason
    assert "; `leave`: pre-condition" in ran.reason


def test_a_simulation_takes_the_same_one(tmp_path: Path) -> None:
    library = Skills(tmp_path, skills(CHOOSING), SCENE, {"simulate": True})
    ran = library.run("Task", "One=bolt", "Object=nut")
    assert ran.outcome.is_success
    assert {each.path[-1] for each in ran.events} == {"task", "Move", "Shove", "Shove#2"}


def test_each_implementation_is_made_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The child starts with `lift`, `other`, and both again."""
    source = skills("self.retry(self.inverter(Move(Object=params.One)), 4)")
    made = "    def onInit(self):\n        print(type(self).__name__)\n\n"
    lift = source[source.index("class lift") : source.index("class Shove")]
    lift = lift.replace("    def execute", f"{made}    def execute")
    other = lift.replace("5.0", "9.0").replace("2.0", "5.0").replace("9.0", "2.0")
    other = other.replace("class lift", "class other")
    start, end = source.index("class lift"), source.index("class Shove")
    source = source[:start] + lift + other + source[end:]
    ran = Skills(tmp_path, source, SCENE).run("Task", "One=nut", "Object=feather")
    assert reported(ran) == ["lifted nut"] * 4
    assert capsys.readouterr().out.split() == ["lift", "other"]
