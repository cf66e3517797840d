"""Primitives whose methods return what is not waited for, or use what is not there."""

from __future__ import annotations

import pytest

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
        "def execute(self):\n    return self.success('a') if self.ok else False",
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
        "def execute(self):\n    if self.ok:\n        return self.success('a')\n    "
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
