"""The rules that guard the robot in each arm of an experiment."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from heron.rules import FOLDER
from heron.variants import ExperimentArm
from rossmarie.driver import compile_file
from rossmarie.ir import Machine

NAVIGATION_RULES = {
    ExperimentArm.DEROS: FOLDER / "navigation_deros.ross",
    ExperimentArm.ROSSMARIE: FOLDER / "navigation.ross",
}
PLACING_RULES = {
    ExperimentArm.DEROS: FOLDER / "placing_deros.ross",
    ExperimentArm.ROSSMARIE: FOLDER / "placing.ross",
}
HUMAN_RULES = {
    ExperimentArm.DEROS: FOLDER / "human_deros.ross",
    ExperimentArm.ROSSMARIE: FOLDER / "human.ross",
}
CONTACT_RULES = {
    ExperimentArm.ROSSMARIE: FOLDER / "contact.ross",
    ExperimentArm.SKILL_AWARE: FOLDER / "contact_skills.ross",
}

CORRIDOR_RULES = {
    ExperimentArm.ROSSMARIE: FOLDER / "corridor.ross",
    ExperimentArm.SKILL_AWARE: FOLDER / "corridor_skills.ross",
    ExperimentArm.PROACTIVE: FOLDER / "corridor_places.ross",
}

BLOCKED_RULES = {
    ExperimentArm.ROSSMARIE: FOLDER / "blocked.ross",
    ExperimentArm.TREES: FOLDER / "blocked_trees.ross",
    ExperimentArm.LEARNED: FOLDER / "blocked_trees.ross",
}


@cache
def machine_of(rules: Path) -> Machine:
    """A rules file, compiled. Raises `RulesError`."""
    return compile_file(rules).machine
