"""Primitives on top of a class of their own: what is a fault in that, and what is none."""

from __future__ import annotations

import pytest

from ezskiros.driver import Checked
from support.skill_files import HEADER, checked
from support.trees import findings


def client(body: str, declared: str = "Goal: str", tree: str = "") -> Checked:
    """A check of two skills on top of a class with these lines."""
    lines = "".join(f"    {line}\n" for line in body.splitlines())
    skills = "".join(
        f"class {name}(SkillDescription):\n    def description(self, {declared}): ...\n\n\n"
        f"class {name.lower()}(Client, {name}.SkillBase):\n"
        f"    def goal(self):\n        return self.params.Goal\n\n\n"
        for name in ("Dock", "Greet")
    )
    head = HEADER + "\nfrom ezskiros import OPTIONAL, State\n\n\n"
    return checked(f"{head}class Client:\n{lines}\n\n{skills}{tree}")


FINE = """\
def onInit(self):
    self.client = None

def onStart(self):
    self.asked = self.goal()
    if self.client is None:
        self.fail("nobody listens", -1)
        return False
    return True

def execute(self) -> State:
    if self.asked is None:
        return State.RUNNING
    return self.on_done(self.node)

def on_done(self, answer):
    return self.success(str(answer))
"""


def test_a_client_has_no_faults() -> None:
    assert findings(client(FINE)) == []


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("return State.RUNNING", "return None", ("EZS540", "None")),
        ("return State.RUNNING", "return self.running()", ("EZS549", "self.running")),
        ("str(answer)", "str(self.params.Gaol)", ("EZS508", "self.params.Gaol")),
        ("return True", "return None", ("EZS541", "None")),
        ("def execute", "def exeucte", ("EZS542", "dock")),
    ],
)
def test_faults_in_a_class_that_skills_are_built_on(
    old: str, new: str, expected: tuple[str, str]
) -> None:
    found = findings(client(FINE.replace(old, new)))
    assert expected in found
    assert {code for code, _ in found} == {expected[0]}


def test_what_a_base_sets_can_be_passed_on() -> None:
    declared = "Goal: str, Found: OPTIONAL[str]"
    tree = """
class Both(SkillDescription):
    def description(self, Place: OPTIONAL[str]): ...


class both(Both.SkillBase):
    def expandBT(self, params):
        self.serialstar(Dock(Goal="a", Found=params.Place), Greet(Goal=params.Place))
"""
    setting = FINE.replace("self.client = None", "self.params.Found = self.client = None")
    assert findings(client(setting, declared, tree)) == []
    assert findings(client(FINE, declared, tree)) != []
