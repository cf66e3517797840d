"""A robot that pushes a thing, and backs off where a rule says so: its skills and its rules. Each
skill notes the events of its life in a file.
"""

from __future__ import annotations

import shutil
from pathlib import Path

from ezskiros.hosts.owl_files import owl_files
from ezskiros.ontology import load
from rossmarie.driver import compile_file
from rossmarie.ir import Machine
from support import command_line
from support.live import Ears
from support.ontologies import HALL
from support.skiros2_live import Robot

SKILLS = """
import os
import time
from pathlib import Path

from ezskiros import SkillDescription
from ezskiros.ontology import load

world = load(Path(__file__).parents[{up}] / "ontology")


def note(*words):
    with open(os.environ["NOTES"], "a") as notes:
        print(*words, time.time(), file=notes)


class Push(SkillDescription):
    def description(self, Object: world.skiros.Product):
        pass


class push(Push.SkillBase):
    def onStart(self):
        note("push", self.params.Object.label)
        return True

    def execute(self):
        return self.step("pushing")

    def onPreempt(self):
        note("preempted")
        return self.fail("stopped", -1)


class BackOff(SkillDescription):
    def description(self, From: world.skiros.Product, Steps: int):
        pass


class back_off(BackOff.SkillBase):
    def onStart(self):
        self.left = self.params.Steps
        note("back_off", self.params.From.label)
        return True

    def execute(self):
        self.left -= 1
        return self.step("backing off") if self.left else self.success("backed off")

    def onPreempt(self):
        note("released")
        return self.fail("stopped", -1)
"""
_RULES = """
skills "skills.json";
input force = topic /force : std_msgs/Float64 in N timeout 3 sec;
action halt { block /cmd_vel : geometry_msgs/Twist; }
action away {
    tree BackOff(From: doing Push.Object, Steps: 10) within 20 sec then resume else halt;
}
action far {
    tree BackOff(From: "cable", Steps: 10000) within 20 min then resume else halt;
}
rule stuck: if force > 5 N then { away; };
rule pulled: if force < -5 N then { far; };
priority stuck over pulled;
"""
"""A push is answered by a short tree, a pull by one that ends with the rule only."""

_HOST = 'from ezskiros.hosts.skiros2 import host\n\nhost(__name__, context="../skills.json")\n'

BEGUN = ["push cable", "preempted", "back_off cable"]


def hosted(folder: Path) -> Robot:
    """A robot that SkiROS2 runs; the folder gets its ontology and scene, its library of skills, and
    their export. The task pushes a cable.
    """
    shutil.copytree(HALL, folder / "ontology")
    shutil.copy(HALL.parent / "lab.turtle", folder)
    library = folder / "backing_skills"
    library.mkdir()
    (library / "__init__.py").write_text(_HOST, encoding="utf-8")
    (library / "motions.py").write_text(SKILLS.format(up=1), encoding="utf-8")
    exported = ("backing_skills", "lab.turtle", "--ontology", "ontology", "-o", "skills.json")
    done = command_line.run("ezskiros", "export", *exported, folder=folder)
    assert done.returncode == 0, done.stdout + done.stderr
    files, found = owl_files(load(folder / "ontology", relations=False))
    assert found == []
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return Robot(
        workspace=folder,
        scene="lab.turtle",
        library="backing_skills",
        skills=["push", "back_off"],
        begins=["push", "Object=cable"],
    )


def rules(folder: Path) -> Machine:
    """The rules, in a folder with the export of the skills."""
    path = folder / "stuck.ross"
    path.write_text(_RULES, encoding="utf-8")
    return compile_file(path).machine


def said(notes: Path) -> list[str]:
    """The notes of the skills, without their times."""
    text = notes.read_text(encoding="utf-8") if notes.is_file() else ""
    return [line.rpartition(" ")[0] for line in text.splitlines()]


def active(state: Ears) -> list[str]:
    """The rules that are active."""
    return list((state.last("/stuck_safety/state") or {}).get("active", ()))


def tasks(state: Ears) -> dict[str, str]:
    """The states of the trees that rules have asked for."""
    reported = (state.last("/stuck_safety/state") or {}).get("tasks", ())
    return {task["action"]: task["state"] for task in reported}
