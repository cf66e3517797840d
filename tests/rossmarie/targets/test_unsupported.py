"""Unsupported features of a target are reported before any file is written."""

from __future__ import annotations

import sys
from dataclasses import replace

import pytest

from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.targets.c99 import TARGET
from rossmarie.targets.unsupported import unsupported
from support.c99_cases import reacting
from support.drafts import Draft

# The package re-exports a function under the name of the module.
unsupported_by_c99 = sys.modules["rossmarie.targets.c99.unsupported"]


def test_an_ordinary_machine_is_supported() -> None:
    draft = Draft()
    draft.rule(draft.above(draft.read(), 1.0))
    assert list(TARGET.unsupported(draft.machine())) == []


def test_more_conditions_than_indexes(monkeypatch: pytest.MonkeyPatch) -> None:
    draft = Draft()
    condition = draft.above(draft.read(), 1.0)
    draft.propositions += [draft.propositions[condition]] * 10
    draft.rule(condition)
    monkeypatch.setattr(unsupported_by_c99, "MOST_INDEXES", 12)
    (found,) = TARGET.unsupported(draft.machine())
    assert found.code == "ROSS501"
    assert found.primary.span == draft.rules[0].span
    assert "13 conditions and rules" in found.primary.text
    monkeypatch.setattr(unsupported_by_c99, "MOST_INDEXES", 13)
    assert list(TARGET.unsupported(draft.machine())) == []


@pytest.mark.parametrize(
    ("bounds", "most", "said"),
    [(1, 13, "14 task commands"), (20, 19, "20 bounds of commands")],
)
def test_more_that_rules_do_than_indexes(
    bounds: int, most: int, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = reacting().reactions
    limit = reactions.Limit(0, (reactions.Bound(0, 0.0, 0.0, None),) * bounds)
    tasks = (replace(found.tasks[0], effect=limit), *found.tasks[1:])
    machine = replace(reacting(), reactions=replace(found, tasks=tasks))
    assert list(TARGET.unsupported(machine)) == []
    monkeypatch.setattr(unsupported_by_c99, "MOST_INDEXES", most)
    (finding,) = TARGET.unsupported(machine)
    assert said in finding.primary.text


def test_more_evaluations_in_one_call_than_any_target_may_need(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    draft = Draft()
    condition = draft.above(draft.read(1), 1.0)
    for duration_ns in (1, 2):
        draft.rule(draft.proposition(ir.Held(condition, duration_ns), text=f"for {duration_ns}"))
    machine = draft.machine()
    monkeypatch.setattr(ir, "MOST_EVALUATIONS", 4)
    assert list(unsupported(machine)) == []
    monkeypatch.setattr(ir, "MOST_EVALUATIONS", 3)
    (found,) = unsupported(machine)
    assert found.code == "ROSS502"
    assert found.primary.text == "with this timer, which can expire once, there are 4"
