"""Packages for ROS 1, built by catkin: each once, whoever asks for it, in whichever process."""

from __future__ import annotations

import fcntl
import hashlib
import json
import shutil
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from support.c_compiler import write
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
    "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG -pipe",
    "-DCMAKE_C_FLAGS_RELEASE=-O1 -DNDEBUG -pipe",
    f"-DCMAKE_PROJECT_INCLUDE={Path(__file__).with_name('ros1_unity.cmake')}",
)
"""Arguments of cmake with which compiling takes a third of the time; the nodes do the same."""

_GENERATORS = Path("/etc/ros/genmsg")
_NEEDED_GENERATORS = ("gencpp", "genpy")


class Workspace:
    """A workspace of catkin in a folder, which several processes may share."""

    def __init__(self, folder: Path, arguments: Sequence[str] = ()) -> None:
        """The arguments are those of cmake."""
        self._folder = folder
        self._arguments = arguments
        self.sources = folder / "src"
        self.devel = folder / "devel"

    def build(self, packages: Mapping[str, Mapping[str, str]]) -> None:
        """Build packages of their files, without a warning: at once those that are new."""
        with self._alone():
            digests = {name: _digest(files) for name, files in packages.items()}
            new = [name for name in packages if self._built(name) != digests[name]]
            if not new:
                return
            for name in new:
                shutil.rmtree(self.sources / name, ignore_errors=True)
                write(packages[name], self.sources / name)
            self._make()
            for name in new:
                self._note(name).write_text(digests[name], encoding="ascii")

    def programs(self, package: str) -> Path:
        """The folder of the programs of a package."""
        return self.devel / "lib" / package

    @contextmanager
    def _alone(self) -> Iterator[None]:
        """No other process is here meanwhile."""
        self._folder.mkdir(parents=True, exist_ok=True)
        with (self._folder / "lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            yield

    def _note(self, package: str) -> Path:
        """The file that says of what a package was built."""
        return self._folder / f"{package}.built"

    def _built(self, package: str) -> str | None:
        note = self._note(package)
        return note.read_text(encoding="ascii") if note.exists() else None

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


def files_of(folder: Path) -> dict[str, str]:
    """The files of a package of this repository."""
    found = (path for path in folder.rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): path.read_text(encoding="utf-8") for path in found}


def _digest(files: Mapping[str, str]) -> str:
    return hashlib.sha256(json.dumps(sorted(files.items())).encode()).hexdigest()
