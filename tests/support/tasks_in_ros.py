"""Tasks that `ezskiros run` runs beside a guard of rules, in live tests."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path

from support import command_line
from support.live import Process, Ros, talking
from support.ontologies import HALL

_DEBIAN = "/usr/lib/python3/dist-packages"
"""The folder of rospy in Debian."""


def export(folder: Path, skills: str, scene: str) -> None:
    """Put an ontology, skills and a scene into a folder, with the export of the skills."""
    shutil.copytree(HALL, folder / "ontology")
    (folder / "lab.turtle").write_text(scene, encoding="utf-8")
    (folder / "skills.py").write_text(skills, encoding="utf-8")
    exported = ("skills.py", "lab.turtle", "--ontology", "ontology", "-o", "skills.json")
    done = command_line.run("ezskiros", "export", *exported, folder=folder)
    assert done.returncode == 0, done.stdout + done.stderr


def begun_task(
    ros: Ros,
    folder: Path,
    task: Sequence[str],
    notes: Path,
    log: Path,
    *,
    namespace: str = "",
    scene: str = "lab.turtle",
) -> Process:
    """A task that runs with the export of a folder; its skills note what they do."""
    words = (task[0], str(folder), *task[1:], "--scene", str(folder / scene))
    options = ("--context", str(folder / "skills.json"), "--ontology", str(folder / "ontology"))
    return begun_run(ros, (*words, *options), log, notes, namespace)


def begun_run(
    ros: Ros, words: Sequence[str], log: Path, notes: Path, namespace: str = ""
) -> Process:
    """A task that runs in a namespace, by the words of a command; its skills note what they do."""
    places = [ros.variables.get("PYTHONPATH", ""), *sys.path]
    if ros.name == "ros1":
        places.append(_DEBIAN)
    paths = os.pathsep.join(filter(None, places))
    variables = {**ros.variables, "PYTHONPATH": paths, "NOTES": str(notes)}
    variables["ROS_NAMESPACE"] = namespace
    return Process([sys.executable, "-m", "ezskiros", "run", *words], variables, log, talking)
