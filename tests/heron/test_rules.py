"""The rules of the experiments: without findings, and the same hazards in all arms."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from heron.rules import FOLDER
from rossmarie.driver import check_file, compile_file
from rossmarie.ir import Machine

EXPERIMENTS = ("navigation", "placing", "human")
CONTACT = ("contact", "contact_skills")
FILES = [*(f"{name}{arm}" for name in EXPERIMENTS for arm in ("", "_deros")), *CONTACT]


def conditions(machine: Machine) -> set[str]:
    """The conditions of the rules, as they are written."""
    return {machine.propositions[rule.condition].text for rule in machine.rules}


@pytest.mark.parametrize("name", FILES)
def test_there_are_no_findings(name: str) -> None:
    assert check_file(FOLDER / f"{name}.ross").diagnostics == ()


def test_they_are_in_the_one_layout() -> None:
    program = Path(sys.executable).with_name("rossmarie")
    files = sorted(FOLDER.glob("*.ross"))
    run = subprocess.run([program, "fmt", "--check", *files], capture_output=True, check=False)
    assert run.returncode == 0, run.stdout


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_both_arms_look_at_the_same_hazards(name: str) -> None:
    ours, theirs = (compile_file(FOLDER / f"{name}{arm}.ross").machine for arm in ("", "_deros"))
    assert conditions(ours) == conditions(theirs)
    assert conditions(ours)
    assert {hazard.name for hazard in ours.hazards} == {hazard.name for hazard in theirs.hazards}
    assert all(rule.release is None for rule in theirs.rules), "DeROS waits for an operator"
    assert all(rule.release is not None for rule in ours.rules), "ROSSMARie never does"


def test_rules_that_know_skills_are_those_that_know_sensors_with_exemptions() -> None:
    """Each exemption has a bound of its own, which acts in the place of the rule."""
    sensors, skills = (compile_file(FOLDER / f"{name}.ross").machine for name in CONTACT)
    (ours,) = sensors.rules
    exempted, *made = skills.rules
    text = skills.propositions[exempted.condition].text
    assert exempted.name == ours.name
    assert text == "contact.hard unless doing Push unless doing Wipe"
    assert [hazard.name for hazard in skills.hazards] == [hazard.name for hazard in sensors.hazards]
    assert {rule.exempts.doing for rule in made if rule.exempts} == {"doing Push", "doing Wipe"}
    acting = [rule.name for rule, plan in zip(skills.rules, skills.reactions.plans, strict=True)
              if plan.tasks]  # fmt: skip
    assert acting == [
        "back_off_on_contact",
        "back_off_on_contact_while_Push",
        "back_off_on_contact_while_Wipe",
    ]
