"""Skills for tests: texts in, findings out."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from textwrap import dedent, indent

from ezskiros.driver import Checked, check_paths
from ezskiros.ontology.load import VARIABLE
from support.ontologies import HALL, PREFIXES

HEADER = """\
from ezskiros import *
from ezskiros.ontology import load

world = load()
cora, rparts, scalable, skiros, sumo = (
    world.cora, world.rparts, world.scalable, world.skiros, world.sumo
)
"""
PARAMETERS = "Object: skiros.Product, Gripper: rparts.GripperEffector, Place: skiros.Container"

SKILL = """
class Skill(SkillDescription):
    def description(self, Object: skiros.Product, Place: skiros.Container):
        {line}
"""
WRONG = "self.pre_conditions += Object.hasAA(Place)"
TYPO = ("EZS301", "Object.hasAA")
"""The findings in `WRONG`."""
VENDOR = """\
import socket

class Arm:
    def __init__(self, address):
        self.socket = socket.create_connection((address, 1))
        self.pose = None

    def speed(self) -> float:
        return float(self.socket.recv(8))

class Sensor:
    @property
    def reading(self):
        return socket.create_connection(("h", 1)).recv(8)

    def connect(self):
        socket.create_connection(("h", 1))

    def value(self):
        raise OSError("not connected")
"""
"""A library that talks to devices."""


def checked(text: str, *, name: str = "skills.py") -> Checked:
    """The findings in the text of a module, with the ontology of the example."""
    before = os.environ.get(VARIABLE)
    os.environ[VARIABLE] = str(HALL)
    try:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / name
            path.write_text(text, encoding="utf-8")
            return check_paths([path])
    finally:
        os.environ.pop(VARIABLE)
        if before is not None:
            os.environ[VARIABLE] = before


def described(body: str, parameters: str = PARAMETERS) -> Checked:
    """The findings in a skill whose description has this body."""
    lines = indent(dedent(body).strip() or "pass", " " * 8)
    text = f"class Skill(SkillDescription):\n    def description(self, {parameters}):\n{lines}\n"
    return checked(f"{HEADER}\n\n{text}")


def skill(line: str) -> str:
    """A module with a skill whose description is one line, or several that are indented like it."""
    return HEADER + SKILL.format(line=line)


def check_folder(folder: Path, **files: str) -> Checked:
    """The findings in modules, by their names, in a new folder `own`."""
    own = folder / "own"
    own.mkdir()
    for name, text in files.items():
        (own / f"{name}.py").write_text(text)
    return check_paths([own])


def found(result: Checked) -> list[tuple[str, str]]:
    """The errors: their codes, and the texts that they point at."""
    return [
        (each.code, each.primary.span.text)
        for each in result.diagnostics
        if each.severity.value == "error"
    ]


def warned(result: Checked) -> list[tuple[str, str]]:
    """The warnings: their codes, and the texts that they point at."""
    return [
        (each.code, each.primary.span.text)
        for each in result.diagnostics
        if each.severity.value == "warning"
    ]


def described_in(ontology: str, body: str, parameters: str) -> Checked:
    """The same, with an ontology in Turtle of its own: its namespace is `test`."""
    lines = indent(dedent(body).strip() or "pass", " " * 8)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "test.ttl"
        path.write_text(PREFIXES + ontology, encoding="utf-8")
        header = (
            "from ezskiros import *\nfrom ezskiros.ontology import load\n"
            f"test = load({str(path)!r}).test\n"
        )
        text = (
            f"class Skill(SkillDescription):\n    def description(self, {parameters}):\n{lines}\n"
        )
        return checked(f"{header}\n\n{text}")
