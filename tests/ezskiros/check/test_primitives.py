"""Primitives whose methods return what is not waited for, or use what is not there."""

from __future__ import annotations

from textwrap import indent

import pytest

from ezskiros.driver import Checked
from support.skill_files import HEADER, checked
from support.trees import findings, primitive

PROTOCOL = [
    ("def execute(self):\n    return True", [("EZS540", "True")]),
    ("def execute(self):\n    return None", [("EZS540", "None")]),
    ("def execute(self):\n    self.success('done')", [("EZS540", "execute")]),
    ("def execute(self):\n    return", [("EZS540", "return")]),
    ("def execute(self):\n    return self.success(5)", [("EZS547", "5")]),
    ("def execute(self):\n    return self.fail('no', 'no')", [("EZS547", "'no'")]),
    (
        "def execute(self):\n    return self.success('a') if self.params else False",
        [("EZS540", "False")],
    ),
    (
        "async def execute(self):\n    return self.success('a')",
        [("EZS540", "async def execute(self):")],
    ),
    ("def execute(self):\n    yield self.step('a')", [("EZS540", "def execute(self):")]),
    ("def exeucte(self):\n    return self.success('a')", [("EZS542", "def exeucte(self):")]),
    ("pass", [("EZS542", "skill")]),
    (
        "def onStart(self):\n    self.count = 0\ndef execute(self):\n    return self.success('a')",
        [("EZS541", "onStart")],
    ),
    (
        "def execute(self):\n    return self.success('a')\ndef onEnd(self):\n    return None",
        [("EZS541", "None")],
    ),
    ("def execute(self):\n    while True:\n        return self.step('a')", []),
    ("def execute(self):\n    raise NotImplementedError", []),
    (
        "def execute(self):\n    if self.params:\n        return self.success('a')\n    "
        "return self.fail('b')",
        [],
    ),
    ("def execute(self):\n    def inner():\n        return 5\n    return self.success('a')", []),
    ("def execute(self):\n    return self.helped()\ndef helped(self):\n    return 5", []),
]


@pytest.mark.parametrize(("methods", "expected"), PROTOCOL, ids=[each for each, _ in PROTOCOL])
def test_primitives_return_what_is_waited_for(
    methods: str, expected: list[tuple[str, str]]
) -> None:
    assert findings(primitive(methods)) == expected


def test_methods_are_about_parameters_that_the_skill_has() -> None:
    found = checked(
        f"{HEADER}\n\nclass Move(SkillDescription):\n"
        "    def description(self, Speed: float = 1.0, Weight: float = 0.0): ...\n\n\n"
        "class move(Move.SkillBase):\n"
        "    def onStart(self):\n"
        "        self.params.Wight = self.params.Speed\n"
        "        return True\n\n"
        "    def execute(self):\n"
        "        return self.success(f'at {self.params.Sped}')\n"
    )
    assert findings(found) == [("EZS508", "self.params.Wight"), ("EZS508", "self.params.Sped")]
    assert [each.help for each in found.diagnostics] == [
        "did you mean `Weight`?",
        "did you mean `Speed`?",
    ]


BODIES = [
    ("return self.sucess('done')", [("EZS549", "self.sucess")]),
    ("return self.success(f'{sped}')", [("EZS548", "sped")]),
    ("return self.success(str(math.sqroot(2)))", [("EZS549", "math.sqroot")]),
    ("return self.success(os.path.jion('a', 'b'))", [("EZS549", "os.path.jion")]),
    ("if self.params.Speed > 2:\n    speed = 1 / 0\nreturn self.step('')", [("EZS539", "1 / 0")]),
    ("return self.step('at ' + 5)", [("EZS539", "'at ' + 5")]),
    ("return self.step(str(5 % 0))", [("EZS539", "5 % 0")]),
    ("form = '%d'\nreturn self.step(form % 0)", []),
    ("return self.step(str(self.params.Speed / 0))", []),
    ("if hasattr(os, 'startfile'):\n    os.startfile('a')\nreturn self.step('')", []),
    ("if sys.platform == 'win32':\n    os.startfile('a')\nreturn self.step('')", []),
    ("if os.name == 'nt':\n    os.startfile('a')\nelse:\n    os.strat()\nreturn self.step('')", []),
    ("found = hasattr(self, 'x') and self.y\nreturn self.step(str(found))", []),
    ("if self.params.Speed > 1:\n    os.strat()\nreturn self.step('')", [("EZS549", "os.strat")]),
    ("object.__setattr__(self, 'count', 1)\nreturn self.step(str(self.count))", []),
    ("def inner():\n    return spede\nreturn self.step(inner())", [("EZS548", "spede")]),
    ("try:\n    self.coutn += 1\nexcept AttributeError:\n    pass\nreturn self.step('')", []),
    (
        "try:\n    return self.step(sped)\nexcept:\n    return self.step(spede)",
        [("EZS548", "spede")],
    ),
    ("if hasattr(self, 'count'):\n    print(self.count)\nreturn self.step('')", []),
    ("self.count = 1\nreturn self.step(str(self.count))", []),
    ("setattr(self, 'count', 1)\nreturn self.step(str(self.count))", []),
    ("global count\ncount = 1\nreturn self.step(str(count))", []),
    ("return self.step(str([each for each in range(3)]))", []),
    ("class Inner:\n    size = 3\n    more = size\nreturn self.step(str(Inner.more))", []),
    ("found: Unknown = 3\nreturn self.step(str(found))", []),
    ("import os.path as paths\nreturn self.step(paths.nothing)", []),
    ("match self.params.Speed:\n    case found:\n        return self.step(str(found))", []),
    ("return self.step(f'{self.wmi} {self.world} {self.now()} {self.node} {__name__}')", []),
    ("return self.step(rospy.anything.at_all)", []),
    ("return self.step('%s' % 0 + str(1.0 / 2) + str(2 % 3) + 'a' * 3)", []),
]
"""Bodies of `execute`, and what is found in them without running them."""


@pytest.mark.parametrize(("body", "expected"), BODIES, ids=[body for body, _ in BODIES])
def test_what_always_raises_is_found_where_it_stands(
    body: str, expected: list[tuple[str, str]]
) -> None:
    assert [each for each in findings(executed(body)) if each[0] != "EZS004"] == expected


def test_an_attribute_that_is_near_is_named() -> None:
    found = executed("return self.sucess('done')").diagnostics
    assert [each.help for each in found if each.code == "EZS549"] == [
        "did you mean `self.success`?"
    ]


def test_attributes_of_bases_and_other_methods_are_there() -> None:
    found = checked(
        f"{HEADER}\n\nclass Move(SkillDescription):\n"
        "    def description(self, Speed: float = 1.0): ...\n\n\n"
        "class Counting:\n"
        "    limit: int\n\n"
        "    def count(self):\n"
        "        self.counted = self.limit + self.limmit\n\n\n"
        "class move(Counting, Move.SkillBase):\n"
        "    def onStart(self):\n"
        "        self.begin, *self.rest = 1, 2\n"
        "        return True\n\n"
        "    def execute(self):\n"
        "        return self.success(f'{self.counted} {self.begin} {self.rest} {self.count()}')\n"
    )
    assert findings(found) == [("EZS549", "self.limmit")]


def test_a_decorated_method_is_looked_at_and_its_decorator_is_not() -> None:
    text = (
        "from functools import wraps\n\n\n"
        "def retried(method):\n"
        "    @wraps(method)\n"
        "    def again(self):\n"
        "        return self.nothing if method is None else method(self)\n\n"
        "    return again\n\n\n"
        "class Move(SkillDescription):\n"
        "    def description(self, Speed: float = 1.0): ...\n\n\n"
        "class move(Move.SkillBase):\n"
        "    @retried\n"
        "    def execute(self):\n"
        "        return self.sucess(f'{self.params.Speed}')\n"
    )
    assert findings(checked(HEADER + text)) == [("EZS549", "self.sucess")]


def executed(body: str) -> Checked:
    """A check of a primitive skill with this `execute`."""
    return checked(
        f"import math, os, sys, rospy\n{HEADER}\n\nclass Move(SkillDescription):\n"
        "    def description(self, Speed: float = 1.0): ...\n\n\n"
        f"class move(Move.SkillBase):\n    def execute(self):\n{indent(body, ' ' * 8)}\n"
    )
