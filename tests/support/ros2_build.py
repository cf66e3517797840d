"""Packages for ROS 2, built by colcon."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

from support import workspace

QUICK = (
    "-DBUILD_TESTING=OFF",
    "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG -pipe",
    "-DCMAKE_C_FLAGS_RELEASE=-O1 -DNDEBUG -pipe",
)
"""Arguments of cmake with which compiling takes less time; the nodes do the same."""


def is_installed(package: str) -> bool:
    """Say whether the sourced ROS has a package."""
    return _prefix(package) is not None


def folder_of(package: str) -> Path:
    """The folder of the programs of a package that is installed."""
    prefix = _prefix(package)
    assert prefix is not None, package
    return prefix / "lib" / package


def has_security() -> bool:
    """Say whether the DDS of the sourced ROS can control access. Fast DDS always can."""
    if "cyclonedds" not in os.environ.get("RMW_IMPLEMENTATION", ""):
        return True
    prefixes = map(Path, os.environ["AMENT_PREFIX_PATH"].split(":"))
    return any(next(each.glob("lib/**/libdds_security_ac.so"), None) for each in prefixes)


def _prefix(package: str) -> Path | None:
    """The folder in which a package is installed."""
    prefixes = map(Path, os.environ["AMENT_PREFIX_PATH"].split(":"))
    return next((each for each in prefixes if (each / "share" / package).is_dir()), None)


class Workspace(workspace.Workspace):
    """A workspace of colcon."""

    def __init__(self, folder: Path, arguments: Sequence[str] = ()) -> None:
        """The arguments are those of cmake."""
        super().__init__(folder)
        self._arguments = arguments

    def programs(self, package: str) -> Path:
        """The folder of the programs of a package."""
        return self._folder / "install" / "lib" / package

    def variables(self) -> dict[str, str]:
        """The environment with what was built."""
        script = f". {self._folder}/install/local_setup.bash && env -0"
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True)
        return dict(line.split("=", 1) for line in done.stdout.split("\0") if line)

    def _make(self) -> None:
        command = ["colcon", "build", "--merge-install", "--executor", "sequential"]
        python = f"-DPython3_EXECUTABLE={shutil.which('python3')}"
        done = subprocess.run(
            [*command, "--cmake-args", python, *self._arguments],
            cwd=self._folder,
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        assert "warning:" not in done.stderr, done.stderr
