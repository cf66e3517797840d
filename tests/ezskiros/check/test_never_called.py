"""Methods of implementations that nothing calls, and that look like those that are called."""

from __future__ import annotations

import pytest

from support.trees import findings, primitive

DOES = "\ndef execute(self):\n    return self.success('a')"


@pytest.mark.parametrize(
    ("name", "help"),
    [
        ("onstart", "did you mean `onStart`?"),
        ("on_end", "did you mean `onEnd`?"),
        ("onPreemt", "did you mean `onPreempt`?"),
        ("condition", "did you mean `conditions`?"),
        ("modifyDescription", "add pre-conditions in `def conditions(self, Parameter):`"),
        ("createDescription", "delete it: `Skill.SkillBase` already names the skill"),
        ("expand", "write the tree in `def expandBT(self, params):`"),
    ],
)
def test_a_method_that_nothing_calls_is_reported(name: str, help: str) -> None:
    (found,) = primitive(f"def {name}(self):\n    return True{DOES}").diagnostics
    assert (found.code, found.help) == ("EZS564", help)
    assert found.primary.span.text == f"def {name}(self):"


@pytest.mark.parametrize("name", ["onstop", "execute_now", "start", "helped", "__len__"])
def test_other_methods_are_helpers(name: str) -> None:
    assert findings(primitive(f"def {name}(self):\n    return True{DOES}")) == []


def test_a_method_that_the_class_uses_is_called() -> None:
    assert (
        findings(
            primitive(
                f"def onstart(self):\n    return 'a'{DOES}".replace("'a')", "self.onstart())")
            )
        )
        == []
    )
