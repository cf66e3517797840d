"""What a target cannot do is said before anything is written."""

from __future__ import annotations

import sys

import pytest

from rossmarie import ir
from rossmarie.targets.c99 import TARGET
from rossmarie.targets.c99.unsupported import MOST_TURNS
from support.drafts import SECOND, Draft

# The package re-exports a function under the name of the module.
unsupported = sys.modules["rossmarie.targets.c99.unsupported"]


def test_an_ordinary_machine_is_supported() -> None:
    draft = Draft()
    draft.rule(draft.above(draft.read(), 1.0))
    assert list(TARGET.unsupported(draft.machine())) == []


def test_turning_points_fill_memory() -> None:
    draft = Draft()
    swinging = draft.truth(ir.Oscillates(draft.read(), MOST_TURNS + 1, SECOND, 0.0))
    draft.rule(swinging)
    (found,) = TARGET.unsupported(draft.machine())
    assert found.code == "ROSS502"
    assert found.primary.span == draft.truths[swinging].span


def test_most_turning_points_are_supported() -> None:
    draft = Draft()
    draft.rule(draft.truth(ir.Oscillates(draft.read(), MOST_TURNS, SECOND, 0.0)))
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
