"""Packages of a workspace, built each once, whoever asks for it, in whichever process."""

from __future__ import annotations

import fcntl
import hashlib
import json
import shutil
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from support.c_compiler import write

SANITIZED = (f"-DCMAKE_PROJECT_INCLUDE_BEFORE={Path(__file__).with_name('sanitized.cmake')}",)
"""Arguments of cmake with which nodes end at undefined behavior, and say where it is."""


class Workspace(ABC):
    """A workspace in a folder, which several processes may share."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.sources = folder / "src"

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

    @abstractmethod
    def programs(self, package: str) -> Path:
        """The folder of the programs of a package."""

    @abstractmethod
    def _make(self) -> None:
        """Build all packages of which the sources have changed."""

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


def files_of(folder: Path) -> dict[str, str]:
    """The files of a package of this repository."""
    found = (path for path in folder.rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): path.read_text(encoding="utf-8") for path in found}


def _digest(files: Mapping[str, str]) -> str:
    return hashlib.sha256(json.dumps(sorted(files.items())).encode()).hexdigest()
