"""Rules that know which skills run in real SkiROS2: an exemption ends with the skill manager."""

from __future__ import annotations

import os
import shutil
import signal
import time
from pathlib import Path

import pytest

from ezskiros.hosts.owl_files import owl_files
from ezskiros.ontology import load
from rossmarie.driver import compile_file
from support import command_line
from support.live import LIMIT, Ears, Process, until
from support.ontologies import HALL
from support.parts import SKIROS2, needs
from support.ros1_live import Ros1
from support.skiros2_live import Robot, SkiROS2

ROOT = Path(__file__).parents[3]
MESSAGES = ROOT / "ros" / "ros1" / "skill_context_msgs"
TIMEOUT = 0.5
"""Seconds after which the rules give up a context: five periods of it."""
SOON = 0.5
"""Seconds in which a node on a busy machine says what it has noticed."""

SKILLS = """
from pathlib import Path

from ezskiros import SkillDescription, contact, force
from ezskiros.ontology import load

world = load(Path(__file__).parents[1] / "ontology")


class Push(SkillDescription):
    def description(self, Object: world.skiros.Product):
        self.permits += contact(Object)
        self.permits += force(Object, "30 N")


class push(Push.SkillBase):
    def execute(self):
        return self.step("pushing")

    def onPreempt(self):
        return self.fail("stopped")
"""
RULES = """
skills "skills.json";
input force = topic /force : std_msgs/Float64 in N timeout 3 sec;
action halt { block /cmd_vel : geometry_msgs/Twist; }
rule contact: if force > 5 N then { halt; }
    unless doing Push then if force > 30 N then { halt; };
"""


CORRIDOR = """
@prefix geo: <http://www.opengis.net/ont/geosparql#> .
skiros:Location-90 a skiros:Location ; rdfs:label "corridor" ; skiros:BaseFrameId "map" ;
    geo:asWKT "POLYGON ((0 0, 9 0, 9 2, 0 2, 0 0))" .
"""
"""A place with a shape, which SkiROS2 reads beside the rest of the scene and has no word for."""


FRAMES = """
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
<http://example.org/frames> a owl:Ontology .
skiros:BaseFrameId a owl:DatatypeProperty .
"""
"""A property that the ontology of SkiROS2 has, and that of the example leaves out."""


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a robot: its ontology and scene, its skills, their export, and its rules."""
    return made(tmp_path_factory.mktemp("pushing"))


def made(folder: Path) -> Path:
    shutil.copytree(HALL, folder / "ontology")
    (folder / "ontology" / "frames.ttl").write_text(FRAMES, encoding="utf-8")
    scene = (HALL.parent / "lab.turtle").read_text(encoding="utf-8")
    (folder / "lab.turtle").write_text(scene + CORRIDOR, encoding="utf-8")
    library = folder / "pushing_skills"
    library.mkdir()
    (library / "__init__.py").write_text("")
    (library / "motions.py").write_text(SKILLS)
    (folder / "pushing.ross").write_text(RULES)
    host = 'from ezskiros.hosts.skiros2 import host\n\nhost(__name__, context="../skills.json")\n'
    (library / "__init__.py").write_text(host)
    exported = ("pushing_skills", "lab.turtle", "--ontology", "ontology")
    command = ("export", *exported, "-o", "skills.json")
    done = command_line.run("ezskiros", *command, folder=folder)
    assert done.returncode == 0, done.stdout + done.stderr
    files, found = owl_files(load(folder / "ontology", relations=False))
    assert found == []
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


pytestmark = [needs(SKIROS2)]


@pytest.fixture
def skiros2(ros1: Ros1, robot: Path, tmp_path: Path, started: list[Process]) -> SkiROS2:
    ros1.prepare([MESSAGES, compile_file(robot / "pushing.ross").machine])
    pushing = Robot(
        workspace=robot,
        scene="lab.turtle",
        library="pushing_skills",
        skills=["push"],
        begins=["push", "Object=cable"],
    )
    return SkiROS2(ros1, pushing, tmp_path, started)


@pytest.fixture
def node(ros1: Ros1, skiros2: SkiROS2, robot: Path, started: list[Process]) -> Ears:
    """The guard; it feels 20 N."""
    (program,) = ros1.prepare([compile_file(robot / "pushing.ross").machine])
    started.append(ros1.publish(20, "/force", "std_msgs/Float64", "data: 20.0"))
    ears = ros1.ears("/pushing_safety/state", "pushing_safety/State")
    started.append(ears)
    started.append(ros1.begin(program, {"patience": LIMIT}))
    return ears


def active(node: Ears) -> set[str]:
    return set((node.last("/pushing_safety/state") or {}).get("active", ()))


def becomes(node: Ears, rules: set[str]) -> float:
    """Seconds until these rules are active, and no others."""
    start = time.monotonic()
    until(lambda: active(node) == rules, f"{rules}, not {active(node)}")
    return time.monotonic() - start


@pytest.mark.parametrize("how", ["killed", "stopped"])
def test_an_exemption_ends_with_the_skill_manager(
    how: str,
    ros1: Ros1,  # who was killed is forgotten after the test
    skiros2: SkiROS2,
    node: Ears,
) -> None:
    becomes(node, {"contact_doing_Push"})
    if how == "killed":
        skiros2.manager.end()
    else:
        os.killpg(skiros2.manager.running.pid, signal.SIGSTOP)
    assert becomes(node, {"contact"}) < TIMEOUT + SOON
    if how == "killed":
        skiros2.begin()
    else:
        os.killpg(skiros2.manager.running.pid, signal.SIGCONT)
    becomes(node, {"contact_doing_Push"})
