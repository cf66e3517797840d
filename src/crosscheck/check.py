"""All queries about a robot, in order."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from crosscheck.channels import find_types_that_differ, find_unread
from crosscheck.deadlines import find_too_long, find_without_deadline
from crosscheck.errors import NotAllAsked
from crosscheck.exemptions import find_unused, find_wider
from crosscheck.fights import find_fights
from crosscheck.individuals import find_never_in_scene, find_no_numbers, find_nothing_to_take
from crosscheck.permissions import find_not_granted
from crosscheck.recoveries import find_hindered
from crosscheck.robot import Robot, load
from crosscheck.tree_conditions import find_tree_conditions
from crosscheck.workable import find_unworkable
from dslkit.diagnostics import Diagnostic
from dslkit.source import Span
from rossmarie.analysis.inquiry import Inquiry, OutOfTimeError

if TYPE_CHECKING:  # only for users with a scene
    from crosscheck.scene import SceneModel

_QUERIES = (
    find_wider,
    find_not_granted,
    find_unworkable,
    find_fights,
    find_tree_conditions,
)
LONGEST_S = 600.0
"""The time limit of the queries about one robot, in seconds of CPU time."""


def check_robot(
    rules: Path,
    *,
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
    scene: Path | None = None,
) -> tuple[Diagnostic, ...]:
    """All findings on rules, on the skills that they name, and on the robot's start scene. Raises
    `OSError` if the scene cannot be read.
    """
    loaded = load(rules, systems=systems, message_folders=message_folders)
    if loaded.robot is None:
        return loaded.diagnostics
    if scene is None:
        return (*loaded.diagnostics, *findings(loaded.robot))
    from crosscheck.scene import load_scene  # with the ontology, which other checks do not need

    world = load_scene(scene, loaded.robot)
    found = findings(loaded.robot, world.scene)
    return (*loaded.diagnostics, *world.diagnostics, *found)


def findings(robot: Robot, scene: SceneModel | None = None) -> Iterator[Diagnostic]:
    """The findings that only rules and skills together show, in a given scene or in any."""
    yield from find_types_that_differ(robot)
    yield from find_unread(robot)
    yield from find_unused(robot)
    yield from find_hindered(robot)
    yield from find_without_deadline(robot)
    yield from find_too_long(robot)
    if scene is not None:
        yield from find_nothing_to_take(robot, scene)
        yield from find_never_in_scene(robot, scene)
    inquiry = Inquiry(robot.machine, time.process_time() + LONGEST_S)
    try:
        for query in _QUERIES:
            yield from query(robot, inquiry)
        if scene is not None:
            yield from find_no_numbers(robot, scene, inquiry)
    except OutOfTimeError:
        start = Span(robot.modules[-1].file, 0, 0)
        yield NotAllAsked(seconds=LONGEST_S).at(start)
