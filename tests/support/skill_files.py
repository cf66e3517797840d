"""Skills for tests: texts in, findings out."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from textwrap import dedent, indent

from ezskiros.driver import Checked, check_paths
from ezskiros.ontology.load import VARIABLE
from support.ontologies import HALL

HEADER = """\
from ezskiros import *
from ezskiros.ontology import load

world = load()
cora, rparts, scalable, skiros, sumo = (
    world.cora, world.rparts, world.scalable, world.skiros, world.sumo
)
"""
PARAMETERS = "Object: skiros.Product, Gripper: rparts.GripperEffector, Place: skiros.Container"


def checked(text: str, *, name: str = "skills.py") -> Checked:
    """What is found in the text of a module, with the ontology of the example."""
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
    """What is found in a skill whose description has this body."""
    lines = indent(dedent(body).strip() or "pass", " " * 8)
    text = f"class Skill(SkillDescription):\n    def description(self, {parameters}):\n{lines}\n"
    return checked(f"{HEADER}\n\n{text}")


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
