"""All questions about a robot, in their order."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from crosscheck.channels import find_types_that_differ, find_unread
from crosscheck.exemptions import find_unused, find_wider
from crosscheck.fights import find_fights
from crosscheck.permissions import find_not_granted
from crosscheck.robot import Robot, load
from crosscheck.workable import find_unworkable
from dslkit.diagnostics import Diagnostic
from rossmarie.analysis.inquiry import Inquiry

LONGEST_S = 600.0
"""The questions about one robot are given up after this, in seconds of processor time."""


def check_robot(
    rules: Path, *, systems: Sequence[Path] = (), message_folders: Sequence[Path] = ()
) -> tuple[Diagnostic, ...]:
    """All findings on rules, and on the skills that they name."""
    loaded = load(rules, systems=systems, message_folders=message_folders)
    if loaded.robot is None:
        return loaded.diagnostics
    return (*loaded.diagnostics, *findings(loaded.robot))


def findings(robot: Robot) -> Iterator[Diagnostic]:
    """The findings that only rules and skills together give."""
    inquiry = Inquiry(robot.machine, time.process_time() + LONGEST_S)
    yield from find_types_that_differ(robot)
    yield from find_unread(robot)
    yield from find_unused(robot)
    yield from find_wider(robot, inquiry)
    yield from find_not_granted(robot, inquiry)
    yield from find_unworkable(robot, inquiry)
    yield from find_fights(robot, inquiry)
