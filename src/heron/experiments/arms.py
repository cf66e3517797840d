"""The rules that guard the robot in each arm of an experiment."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from heron.rules import FOLDER
from heron.variants import Arm
from rossmarie.driver import compile_file
from rossmarie.ir import Machine

NAVIGATION_RULES = {
    Arm.DEROS: FOLDER / "navigation_deros.ross",
    Arm.ROSSMARIE: FOLDER / "navigation.ross",
}
PLACING_RULES = {
    Arm.DEROS: FOLDER / "placing_deros.ross",
    Arm.ROSSMARIE: FOLDER / "placing.ross",
}
HUMAN_RULES = {
    Arm.DEROS: FOLDER / "human_deros.ross",
    Arm.ROSSMARIE: FOLDER / "human.ross",
}
CONTACT_RULES = {
    Arm.ROSSMARIE: FOLDER / "contact.ross",
    Arm.SKILL_AWARE: FOLDER / "contact_skills.ross",
}

CORRIDOR_RULES = {
    Arm.ROSSMARIE: FOLDER / "corridor.ross",
    Arm.SKILL_AWARE: FOLDER / "corridor_skills.ross",
    Arm.PROACTIVE: FOLDER / "corridor_places.ross",
}

BLOCKED_RULES = {
    Arm.ROSSMARIE: FOLDER / "blocked.ross",
    Arm.TREES: FOLDER / "blocked_trees.ross",
    Arm.LEARNED: FOLDER / "blocked_trees.ross",
}


@cache
def machine_of(rules: Path) -> Machine:
    """A rules file, compiled. Raises `RulesError`."""
    return compile_file(rules).machine
