"""The listings of the thesis are programs of the language as they are printed."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from rossmarie.syntax import ast

EXAMPLES = Path(__file__).parents[3] / "examples"
THESIS = EXAMPLES / "thesis"


@pytest.mark.parametrize("path", sorted(EXAMPLES.rglob("*.ross")), ids=lambda path: path.name)
def test_every_example_parses(accepted: Callable[[str], ast.Module], path: Path) -> None:
    assert accepted(path.read_text(encoding="utf-8")).items


def names(module: ast.Module) -> list[str]:
    found = []
    for item in module.items:
        if not isinstance(item, ast.Import | ast.Rule | ast.Priority | ast.Skills | ast.Test):
            found.append(item.name.text)
        if isinstance(item, ast.Entity):
            found += [f"{item.name.text}.{condition.name.text}" for condition in item.conditions]
    return found


def test_the_arm_as_printed(accepted: Callable[[str], ast.Module]) -> None:
    module = accepted((THESIS / "arm_as_printed.ross").read_text(encoding="utf-8"))
    assert names(module) == [
        "decrease_stiffness",
        "retract",
        "torque_control_mode",
        "max_force",
        "max_torque",
        "force",
        "torque",
        "force_monitor",
        "force_monitor.oscillation_not_safe",
        "torque_monitor",
        "torque_monitor.torque_too_high",
    ]
    first, second = (item for item in module.items if isinstance(item, ast.Rule))
    assert [action.text for action in first.actions] == ["decrease_stiffness", "retract"]
    assert [action.text for action in second.actions] == ["torque_control_mode"]


def test_peg_in_hole_as_printed_keeps_its_documentation(
    accepted: Callable[[str], ast.Module],
) -> None:
    module = accepted((THESIS / "peg_in_hole_as_printed.ross").read_text(encoding="utf-8"))
    rules = [item for item in module.items if isinstance(item, ast.Rule)]
    assert [rule.documentation for rule in rules] == [
        "Task dependent safety rule",
        "Task independent safety rule",
    ]
