"""Experiment IV in real SkiROS2: Heron's own skills push its box, under the generated node."""

from __future__ import annotations

import shutil
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest

from support.parts import MUJOCO, SKIROS2, require

require(MUJOCO)
require(SKIROS2)

from ezskiros.hosts.owl_files import owl_files
from ezskiros.ontology import load
from heron.experiments.arms import CONTACT_RULES, machine_of
from heron.skills import FOLDER
from heron.variants import ExperimentArm
from rossmarie.ir import Machine
from support.live import LIMIT, Ears, Process, talking, until
from support.ros1_live import Ros1
from support.skiros2_live import Robot, SkiROS2

ROOT = Path(__file__).parents[3]
CELL = ROOT / "tests" / "support" / "heron_arm_in_ros1.py"
MESSAGES = ROOT / "ros" / "ros1" / "skill_context_msgs"
ACTION = ROOT / "src" / "heron" / "rules" / "msg" / "heron_msgs"
RULE, EXEMPTED = "back_off_on_contact", "back_off_on_contact_doing_Push"
SCENE = "contact.turtle"
ROBOT = """
@prefix cora: <http://www.inf.ufrgs.br/phi-group/ontologies/cora.owl#> .
@prefix heron: <http://example.org/ontologies/heron.owl#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .

<http://example.org/ontologies/robot.owl> a owl:Ontology .
cora:Robot a owl:Class .
heron:Robot rdfs:subClassOf cora:Robot .
"""
STATE, PUSHED = "/contact_skills_safety/state", "/pushed"
TIDY = ["tidy_up", "Box=box", "Mark=mark", "Board=board"]
BEGUN, AT_MARK = 0.01, 0.13
"""Distances by which the box is pushed (m). The distance to the mark is at least 0.14 m."""
LATE_NS = 3_000_000_000
TIMEOUT, SOON = 0.5, 0.5
"""Seconds: of the context, and in which a node on a busy machine says what it has noticed."""


@pytest.fixture
def skiros2(ros1: Ros1, tmp_path: Path, started: list[Process]) -> SkiROS2:
    """SkiROS2 tidies up, with the arm and the guard."""
    *_, program = ros1.prepare(
        [MESSAGES, ACTION, patient(CONTACT_RULES[ExperimentArm.SKILL_AWARE])]
    )
    prepare_workspace(tmp_path)
    started.append(ros1.begin(program, {"patience": LIMIT}))
    robot = Robot(
        workspace=tmp_path,
        scene=SCENE,
        library="heron.skills",
        skills=["reach", "push", "wipe", "tidy_up"],
        begins=TIDY,
    )
    return SkiROS2(ros1, robot, tmp_path, started)


def patient(rules: Path) -> Machine:
    """Rules that bear with a force which a busy machine computes late."""
    machine = machine_of(rules)
    (force,) = (each for each in machine.inputs if each.name == "force")
    inputs = [
        replace(each, timeout_ns=LATE_NS) if each is force else each for each in machine.inputs
    ]
    return replace(machine, inputs=tuple(inputs))


def prepare_workspace(folder: Path) -> None:
    """Heron's ontology, in which its robot is one of SkiROS2's, and its scene."""
    ontology = folder / "ontology"
    ontology.mkdir()
    shutil.copy(FOLDER / "heron.ttl", ontology)
    (ontology / "robot.ttl").write_text(ROBOT, encoding="utf-8")
    files, found = owl_files(load(ontology, relations=False))
    assert found == []
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    scene = (FOLDER / SCENE).read_text(encoding="utf-8")
    named = scene.replace('rdfs:label "heron"', 'rdfs:label "skiros:heron"')
    (folder / SCENE).write_text(named, encoding="utf-8")


@pytest.fixture
def ears(ros1: Ros1, skiros2: SkiROS2, started: list[Process]) -> Ears:
    """A node that hears the guard, and how far the box is pushed."""
    heard = [STATE, "contact_skills_safety/State", PUSHED, "std_msgs/Float64"]
    ears = ros1.ears(*heard)
    started.append(ears)
    return ears


@pytest.fixture
def arm(skiros2: SkiROS2, tmp_path: Path, started: list[Process]) -> Process:
    """The arm in its cell."""
    process = Process([sys.executable, str(CELL)], skiros2.variables, tmp_path / "arm.log", talking)
    started.append(process)
    return process


def pushed(ears: Ears) -> float:
    return float((ears.last(PUSHED) or {"data": 0.0})["data"])


def active(ears: Ears) -> set[str]:
    return set((ears.last(STATE) or {}).get("active", ()))


@pytest.mark.usefixtures("arm")
def test_its_push_succeeds_though_it_is_contact(ears: Ears) -> None:
    until(lambda: pushed(ears) > AT_MARK, "the box is at its mark")
    seen = {rule for state in ears.heard(STATE) for rule in state["active"]}
    assert EXEMPTED in seen
    assert RULE not in seen


@pytest.mark.usefixtures("arm")
def test_without_its_skill_manager_the_push_is_stopped(skiros2: SkiROS2, ears: Ears) -> None:
    """The arm still has the goal: nobody but the rules takes it away."""
    until(lambda: pushed(ears) > BEGUN, "the box moves")
    skiros2.manager.end()
    end = time.monotonic() + TIMEOUT + SOON
    until(lambda: RULE in active(ears), f"the rule acts, not {active(ears)}")
    assert time.monotonic() < end
    until(lambda: active(ears) == set(), "the arm has backed off")
    assert pushed(ears) < AT_MARK
