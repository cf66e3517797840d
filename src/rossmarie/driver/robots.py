"""The built-in robots: folders with a system model, rules, their tests and a recording."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit.examples import files_of, named
from rossmarie.driver.workspace import SYSTEM_MODEL

ROBOTS = Path(__file__).parents[1] / "robots"
"""The folder of all robots; each has a subfolder with its name."""

_COMMENT = "//"


@dataclass(frozen=True)
class BuiltInRobot:
    """A built-in robot, and its folder."""

    folder: Path

    @property
    def name(self) -> str:
        """The name of the robot. Its rules and its recording have the same name."""
        return self.folder.name

    @property
    def summary(self) -> str:
        """The first line of its system model, which is a comment."""
        with (self.folder / SYSTEM_MODEL).open(encoding="utf-8") as stream:
            return stream.readline().removeprefix(_COMMENT).strip()

    @property
    def rules(self) -> Path:
        """The path of the robot's rules."""
        return self.folder / f"{self.name}.ross"

    @property
    def recording(self) -> Path:
        """The path of the robot's recording, which makes each rule active and then inactive."""
        return self.folder / f"{self.name}.mcap"

    @property
    def files(self) -> Sequence[Path]:
        """All its files, as paths in its folder, sorted by name."""
        return files_of(self.folder)


def robots() -> Sequence[BuiltInRobot]:
    """All built-in robots, sorted by name."""
    models = ROBOTS.glob(f"*/{SYSTEM_MODEL}")
    return [BuiltInRobot(folder) for folder in sorted(path.parent for path in models)]


def robot(name: str) -> BuiltInRobot:
    """The robot with this name, in upper or lower case. Raises `UnknownExampleError`."""
    return named({each.name: each for each in robots()}, name, "robot")
