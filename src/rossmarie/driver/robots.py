"""The robots in the box: folders of a system model, rules, their tests and a recording."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit.examples import files_of, named
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
        return files_of(self.folder)


def robots() -> Sequence[Robot]:
    """All robots in the box, in the order of their names."""
    models = ROBOTS.glob(f"*/{SYSTEM_MODEL}")
    return [Robot(folder) for folder in sorted(path.parent for path in models)]


def robot(name: str) -> Robot:
    """The robot of a name, in upper or lower case. Raises `UnknownExampleError`."""
    return named({each.name: each for each in robots()}, name, "robot")
