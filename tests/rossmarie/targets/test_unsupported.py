"""What a target cannot do is said before anything is written."""

from __future__ import annotations

import sys

import pytest

from rossmarie.targets.c99 import TARGET
from support.drafts import Draft

# The package re-exports a function under the name of the module.
unsupported = sys.modules["rossmarie.targets.c99.unsupported"]


def test_an_ordinary_machine_is_supported() -> None:
    draft = Draft()
    draft.rule(draft.above(draft.read(), 1.0))
    assert list(TARGET.unsupported(draft.machine())) == []


def test_more_conditions_than_indexes(monkeypatch: pytest.MonkeyPatch) -> None:
    draft = Draft()
    condition = draft.above(draft.read(), 1.0)
    draft.truths += [draft.truths[condition]] * 10
    draft.rule(condition)
    monkeypatch.setattr(unsupported, "MOST_INDEXES", 12)
    (found,) = TARGET.unsupported(draft.machine())
    assert found.code == "ROSS501"
    assert found.primary.span == draft.rules[0].span
    assert "13 conditions and rules" in found.primary.text
    monkeypatch.setattr(unsupported, "MOST_INDEXES", 13)
    assert list(TARGET.unsupported(draft.machine())) == []
