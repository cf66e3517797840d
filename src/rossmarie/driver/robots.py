"""The robots in the box: folders of a system model, rules, their tests and a recording."""

from __future__ import annotations

import difflib
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit.writing import write_whole
from rossmarie.driver.workspace import SYSTEM_MODEL

ROBOTS = Path(__file__).parents[1] / "robots"
"""A folder for each robot, called by its name."""

_COMMENT = "//"


@dataclass(frozen=True)
class Robot:
    """A robot in the box, and its folder."""

    folder: Path

    @property
    def name(self) -> str:
        """The name by which users ask for it; its rules and its recording go by it as well."""
        return self.folder.name

    @property
    def summary(self) -> str:
        """One line: the comment in the first line of its system model."""
        with (self.folder / SYSTEM_MODEL).open(encoding="utf-8") as stream:
            return stream.readline().removeprefix(_COMMENT).strip()

    @property
    def rules(self) -> Path:
        """Its rules."""
        return self.folder / f"{self.name}.ross"

    @property
    def recording(self) -> Path:
        """Its recording, which makes each rule active and inactive again."""
        return self.folder / f"{self.name}.mcap"

    @property
    def files(self) -> Sequence[Path]:
        """All its files, by their paths in its folder, in the order of their names."""
        inside = (path for path in self.folder.rglob("*") if path.is_file())
        return sorted(path.relative_to(self.folder) for path in inside)


class UnknownRobotError(LookupError):
    """There is no robot of this name; the message says so to a user."""


class FilesAreThereError(Exception):
    """Files of this name are there already: `paths`. None was written."""

    def __init__(self, paths: Sequence[Path]) -> None:
        super().__init__(", ".join(map(str, paths)))
        self.paths = paths


def robots() -> Sequence[Robot]:
    """All robots in the box, in the order of their names."""
    models = ROBOTS.glob(f"*/{SYSTEM_MODEL}")
    return [Robot(folder) for folder in sorted(path.parent for path in models)]


def robot(name: str) -> Robot:
    """The robot of a name, in upper or lower case. Raises `UnknownRobotError`."""
    known = {each.name: each for each in robots()}
    if found := known.get(name.lower()):
        return found
    near = difflib.get_close_matches(name.lower(), known, n=1)
    hint = f"did you mean `{near[0]}`?" if near else f"there are {', '.join(known)}"
    raise UnknownRobotError(f"there is no robot `{name}` in the box; {hint}")


def copy_robot(copied: Robot, folder: Path, *, replaces_others: bool = False) -> Sequence[Path]:
    """Copy the files of a robot into a folder, which need not exist yet: what was written. Raises
    `FilesAreThereError` before anything is written, unless it `replaces_others`, and `OSError`.
    """
    targets = [folder / each for each in copied.files]
    present = [path for path in targets if os.path.lexists(path)]
    if present and not replaces_others:
        raise FilesAreThereError(present)
    for source, target in zip(copied.files, targets, strict=True):
        target.parent.mkdir(parents=True, exist_ok=True)
        write_whole(target, (copied.folder / source).read_bytes())
    return targets
