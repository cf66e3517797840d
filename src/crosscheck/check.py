"""All questions about a robot, in their order."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from crosscheck.channels import find_types_that_differ, find_unread
from crosscheck.errors import NotAllAsked
from crosscheck.exemptions import find_unused, find_wider
from crosscheck.fights import find_fights
from crosscheck.permissions import find_not_granted
from crosscheck.robot import Robot, load
from crosscheck.workable import find_unworkable
from dslkit.diagnostics import Diagnostic
from dslkit.source import Span
from rossmarie.analysis.inquiry import Inquiry, OutOfTimeError

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
    yield from find_types_that_differ(robot)
    yield from find_unread(robot)
    yield from find_unused(robot)
    inquiry = Inquiry(robot.machine, time.process_time() + LONGEST_S)
    try:
        for question in (find_wider, find_not_granted, find_unworkable, find_fights):
            yield from question(robot, inquiry)
    except OutOfTimeError:
        start = Span(robot.modules[-1].file, 0, 0)
        yield NotAllAsked(seconds=LONGEST_S).at(start)
