"""Robots for tests: the skills of an example, exported for real, and rules beside them."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path

from crosscheck.check import check_robot
from dslkit.diagnostics import Diagnostic
from support import command_line

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "examples" / "whiteboard"


def put_example(folder: Path, modules: Mapping[str, str] | None = None) -> Path:
    """A copy of the example with more modules of skills, exported; gives its folder."""
    robot = folder / "whiteboard"
    shutil.copytree(EXAMPLE, robot)
    for name, text in (modules or {}).items():
        (robot / "skills" / name).write_text(text, encoding="utf-8")
    done = command_line.run("ezskiros", "export", "skills", "-o", "skills.json", folder=robot)
    assert done.returncode == 0, done.stdout + done.stderr
    return robot


def found_with(robot: Path, rules: str, scene: Path | None = None) -> tuple[Diagnostic, ...]:
    """The findings on rules beside the skills of a robot, in a scene or in any."""
    path = robot / "rules.ross"
    path.write_text(rules, encoding="utf-8")
    return check_robot(path, scene=scene)


def codes(found: tuple[Diagnostic, ...]) -> list[str]:
    """Their codes."""
    return [each.code for each in found]
