"""A robot for a command that needs one without errors."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from crosscheck.cli.output import output
from crosscheck.robot import Robot, load


def loaded(rules: Path, systems: Sequence[Path], message_folders: Sequence[Path]) -> Robot:
    """The robot; its errors end the run."""
    found = load(rules, systems=systems, message_folders=message_folders)
    if found.robot is None:
        output.reject(found.diagnostics)
    return found.robot
