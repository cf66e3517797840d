"""The coverage of rules by tests."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie import ir
from rossmarie.report.coverage import describe
from rossmarie.testing.coverage import cover
from rossmarie.testing.goals import goals, visible_step
from rossmarie.testing.propose import propose
from rossmarie.testing.unreachable import unreachable
from support.compiled import machine_of_condition
from support.testing import run_text


def reached(folder: Path, rules: str, body: str) -> set[str]:
    """The coverage of a test with some statements: the subject and the aspect, in words."""
    found = run_text(folder, f'{rules}\ntest "a" {{ {body} expect r inactive at 5 s; }}')
    machine = found.machine
    return {
        f"{shown(machine, goal.subject, goal.aspect.value)} {describe(machine, goal)}".strip()
        for goal in found.coverage.reached
    }


def shown(machine: ir.Machine, subject: int, aspect: str) -> str:
    return "" if subject < 0 or aspect == "stale" else machine.propositions[subject].text


RULE = "rule r: if speed > 1 m/s and not ok then { slow; };"
EVERY = "every 0.1 s from 0 s to 5 s speed, ok;"


def test_a_condition_counts_only_while_the_decision_hangs_on_it(tmp_path: Path) -> None:
    body = f"{EVERY} at 0 s ok = true, speed = 0 m/s; at 1 s speed = 2 m/s; at 2 s ok = false;"
    assert reached(tmp_path, RULE, body) == {"speed > 1 m/s true", "ok true", "ok false", "active"}


def test_a_condition_that_stands_twice_is_turned_round_in_both_places(tmp_path: Path) -> None:
    rule = "rule r: if (speed > 1 m/s and ok) or (not (speed > 1 m/s) and ok) then { slow; };"
    body = f"{EVERY} at 0 s ok = true, speed = 2 m/s; at 1 s ok = false;"
    assert reached(tmp_path, rule, body) == {"ok true", "ok false", "active", "cleared"}


def test_boundaries(tmp_path: Path) -> None:
    body = f"{EVERY} at 0 s ok = false, speed = 0.999 m/s; at 1 s speed = 1 m/s;"
    body += " at 2 s speed = 1.1 m/s;"
    found = {goal for goal in reached(tmp_path, RULE, body) if "just" in goal or " at " in goal}
    assert found == {"speed > 1 m/s just under 1 m/s", "speed > 1 m/s at 1 m/s"}


def test_deadlines(tmp_path: Path) -> None:
    rule = "rule r: if ok for 1 sec then { slow; };"
    every = "every 0.1 s from 0 s to 5 s ok;"
    early = f"{every} at 0 s ok = true; at 0.999 s ok = false;"
    assert "ok for 1 sec just under the time" in reached(tmp_path, rule, early)
    far_too_early = f"{every} at 0 s ok = true; at 0.9 s ok = false;"
    assert "ok for 1 sec just under the time" not in reached(tmp_path, rule, far_too_early)
    in_time = f"{every} at 0 s ok = true; at 1.5 s ok = false;"
    assert "ok for 1 sec at the time" in reached(tmp_path, rule, in_time)


def test_a_stale_input_counts_if_the_rule_is_unknown_for_it(tmp_path: Path) -> None:
    both = "every 0.1 s from 0 s to 1 s speed; every 0.1 s from 0 s to 5 s ok = "
    assert "speed stale" in reached(tmp_path, RULE, f"{both} false;")
    assert "speed stale" not in reached(tmp_path, RULE, f"{both} true;")


def test_what_nothing_can_show_is_said_to_be_so(tmp_path: Path) -> None:
    rule = "rule r: if speed > 3 m/s and speed < 2 m/s then { slow; };"
    found = run_text(tmp_path, rule)
    reasons = unreachable(found.machine, found.coverage.goals)
    assert {describe(found.machine, goal) for goal in reasons} == {
        "true", "just under 2 m/s", "at 2 m/s", "just over 2 m/s",
        "just under 3 m/s", "at 3 m/s", "just over 3 m/s",
    }  # fmt: skip


def test_what_can_be_is_never_said_to_be_unreachable(tmp_path: Path) -> None:
    fast = "(speed > 1 m/s or abs(speed) > 2 m/s)"
    rough = "norm(acceleration) < 3 m/s^2 and acceleration.y > 1 m/s^2"
    rule = f"rule r: if {fast} and (({rough}) for 1 sec) then {{ slow; }};"
    found = run_text(tmp_path, rule)
    assert unreachable(found.machine, found.coverage.goals) == {}


def test_steps_are_a_thousandth_or_less() -> None:
    assert [visible_step(each) for each in (10, 13, 0.8, -1.5, 0, 200)] == [
        0.01, 0.01, 0.0001, 0.001, 0.001, 0.1,
    ]  # fmt: skip


@pytest.mark.parametrize(
    "condition",
    [
        "estop since battery > 3 V",
        "once battery > 3 V within 2 sec",
        "not after estop, battery > 3 V within 2 sec",
        "(estop since battery > 3 V) for 1 sec",
        'battery > 5 V for 1 sec since mode == "a"',
    ],
)
def test_generated_tests_cover_what_looks_back_in_time(condition: str) -> None:
    machine = machine_of_condition(condition)
    found = cover(machine, [proposal.script for proposal in propose(machine)])
    assert set(found.goals) == found.reached


def test_what_looks_back_in_time_is_covered_as_it_was_written() -> None:
    machine = machine_of_condition("not after estop, battery > 3 V within 2 sec")
    subjects = {goal.subject for goal in goals(machine) if goal.subject >= 0}
    assert {machine.propositions[subject].text for subject in subjects} == {
        "after estop, battery > 3 V within 2 sec",
        "estop",
        "battery > 3 V",
    }
