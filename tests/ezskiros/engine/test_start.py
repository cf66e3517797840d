"""The start of primitives: calls once and at each start, and reasons why a start fails."""

from __future__ import annotations

from pathlib import Path

import pytest

from support.engine import Skills


def primitive(body: str) -> str:
    """A skill `Act` whose implementation is written in the lines of `body`."""
    lines = "\n".join(f"    {line}" for line in body.splitlines())
    return (
        "class Act(SkillDescription):\n    def description(self): pass\n"
        f"class act(Act.SkillBase):\n{lines}\n"
    )


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("def onStart(self):\n    self.fail('no bus', 3)\n    return False\n"
         "def execute(self):\n    return self.success()", "no bus"),
        ("def onInit(self):\n    return False\ndef execute(self):\n    return self.success()",
         "`onInit` reported a failure"),
        ("def onInit(self):\n    self.fail('no bus', 3)\n    return False\n"
         "def execute(self):\n    return self.success()", "no bus"),
        ("def onInit(self):\n    raise KeyError('arm')\n"
         "def execute(self):\n    return self.success()", "`onInit` raised KeyError"),
    ],
)  # fmt: skip
def test_why_a_primitive_cannot_start(tmp_path: Path, body: str, said: str) -> None:
    ran = Skills(tmp_path, primitive(body)).run("Act")
    assert not ran.outcome.is_success
    assert said in ran.reason


def test_on_init_is_called_once_and_need_not_say_anything(tmp_path: Path) -> None:
    body = (
        "made = []\n"
        "def onInit(self):\n    self.made.append(self.now())\n"
        "def execute(self):\n    return self.fail(f'made {self.made}')\n"
    )
    again = (
        "class Again(SkillDescription):\n    def description(self): pass\n"
        "class again(Again.SkillBase):\n    def expandBT(self, params):\n"
        "        self.retry(Act(), 3)\n"
    )
    notes = Skills(tmp_path, primitive(body) + again).run("Again").notes
    assert [each for each in notes if "made" in each][:3] == ["made [0.0]"] * 3
