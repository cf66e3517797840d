"""The projects of `packages/`, and environments that have exactly what a wheel asks for."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from itertools import chain
from pathlib import Path
from types import ModuleType
from typing import Any

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Project:
    """A project: its folder, and the table `project` of its file."""

    folder: Path
    table: Mapping[str, Any]

    @property
    def name(self) -> str:
        """The name of its distribution."""
        return str(self.table["name"])

    @property
    def module(self) -> str:
        """The name of its top-level module."""
        (found,) = (self.folder / "src").iterdir()
        return found.name

    @property
    def extras(self) -> Mapping[str, Sequence[str]]:
        """The requirements of each extra."""
        return dict(self.table.get("optional-dependencies", {}))

    @property
    def requirements(self) -> Sequence[Requirement]:
        """All requirements, those of extras included."""
        texts = chain(self.table.get("dependencies", ()), *self.extras.values())
        return [Requirement(text) for text in texts]


@cache
def projects() -> Mapping[str, Project]:
    """The projects by the names of their distributions."""
    files = sorted((ROOT / "packages").glob("*/pyproject.toml"))
    tables = [tomllib.loads(file.read_text(encoding="utf-8"))["project"] for file in files]
    found = [Project(file.parent, table) for file, table in zip(files, tables, strict=True)]
    return {each.name: each for each in found}


@cache
def dist() -> ModuleType:
    """The program `tools/dist.py`."""
    spec = importlib.util.spec_from_file_location("dist", ROOT / "tools" / "dist.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["dist"] = module
    spec.loader.exec_module(module)
    return module


def linked(folder: Path, requirement: str, wheels: Sequence[Path]) -> Path:
    """An environment with our wheels that a requirement asks for, and links to the installed
    distributions that they ask for in turn. Nothing else can be imported in it. Returns the folder
    of its programs.
    """
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", folder], check=True)
    (site,) = folder.glob("lib/python*/site-packages")
    needed = closure(requirement)
    for name in needed - set(projects()):
        _link(distribution(name), site)
    ours = {each.name.partition("-")[0].replace("_", "-"): each for each in wheels}
    files = [str(ours[name]) for name in sorted(needed & set(projects()))]
    words = ("-m", "pip", "--python", str(folder), "install", "--quiet", "--no-deps", "--no-index")
    subprocess.run([sys.executable, *words, "--disable-pip-version-check", *files], check=True)
    return folder / "bin"


def closure(requirement: str) -> set[str]:
    """The names of all installed distributions that a requirement leads to, markers considered."""
    found: set[tuple[str, str]] = set()
    left = [Requirement(requirement)]
    while left:
        required = left.pop()
        name = canonicalize_name(required.name)
        for extra in ("", *required.extras):
            if (name, extra) not in found:
                found.add((name, extra))
                left += _required(name, extra)
    return {name for name, _ in found}


def _required(name: str, extra: str) -> Iterator[Requirement]:
    project = projects().get(name)
    if project is not None:
        texts = project.extras[extra] if extra else project.table.get("dependencies", ())
        asked = [Requirement(text) for text in texts]
        yield from (each for each in asked if each.marker is None or each.marker.evaluate())
        return
    try:
        lines = distribution(name).requires or ()
    except PackageNotFoundError:
        raise AssertionError(f"{name} is not installed here: run make") from None
    for each in map(Requirement, lines):
        marker = each.marker
        if marker is None or marker.evaluate({"extra": extra}):
            yield each


def _link(installed: Distribution, site: Path) -> None:
    """Link the files of a distribution, and whole folders where no other one shares them."""
    tops = {file.parts[0] for file in installed.files or () if not file.parts[0].startswith("..")}
    for top in sorted(tops - {"__pycache__"}):
        source, target = Path(str(installed.locate_file(top))), site / top
        if not target.exists():
            target.symlink_to(source, target_is_directory=source.is_dir())
