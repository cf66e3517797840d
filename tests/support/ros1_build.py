"""Packages for ROS 1, built by catkin."""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from pathlib import Path

from support import workspace
from support.ros1_python import PYTHON

VARIABLES = {
    "PATH": "/usr/bin:/bin:/usr/sbin:/sbin",
    "ROS_ETC_DIR": "/etc/ros",
    "ROS_ROOT": "/usr/share/ros",
    "ROS_DISTRO": "Debian",
    "ROS_VERSION": "1",
    "ROS_PYTHON_VERSION": "3",
}
"""Those of ROS that are the same for everybody; Debian has no file that sets them."""

QUICK = (
    "-DCATKIN_ENABLE_TESTING=OFF",
    "-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DNDEBUG -pipe",
    "-DCMAKE_C_FLAGS_RELEASE=-O0 -DNDEBUG -pipe",
    f"-DCMAKE_PROJECT_INCLUDE={Path(__file__).with_name('ros1_unity.cmake')}",
)
"""Arguments of cmake with which compiling takes a third of the time; the nodes do the same."""

_GENERATORS = Path("/etc/ros/genmsg")
_NEEDED_GENERATORS = ("gencpp", "genpy")


class Workspace(workspace.Workspace):
    """A workspace of catkin."""

    def __init__(self, folder: Path, arguments: Sequence[str] = ()) -> None:
        """The arguments are those of cmake."""
        super().__init__(folder)
        self._arguments = arguments
        self.devel = folder / "devel"

    def programs(self, package: str) -> Path:
        """The folder of the programs of a package."""
        return self.devel / "lib" / package

    def _make(self) -> None:
        command = ["catkin_make", "-j2", f"-DPYTHON_EXECUTABLE={PYTHON}", *self._arguments]
        done = subprocess.run(
            command, cwd=self._folder, env=self._variables(), capture_output=True, text=True
        )
        assert done.returncode == 0, done.stdout + done.stderr
        assert "warning:" not in done.stderr, done.stderr

    def _variables(self) -> dict[str, str]:
        """Messages are made for C++ and Python only, the languages of the tests."""
        known = {each.name for each in _GENERATORS.glob("gen*")}
        return {
            **VARIABLES,
            "HOME": str(self._folder),
            "ROS_PACKAGE_PATH": f"{self.sources}:/usr/share",
            "CMAKE_PREFIX_PATH": f"{self.devel}:/usr",
            "ROS_LANG_DISABLE": ":".join(sorted(known.difference(_NEEDED_GENERATORS))),
        }
