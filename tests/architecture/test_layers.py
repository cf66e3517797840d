"""Imports run downwards only, as contracts in pyproject.toml say; the page shows their layers."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import pytest

from support.markdown import blocks

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).parents[2]

Layers = Mapping[str, Sequence[str]]
"""The lines of packages, from the top to the bottom: `check | naming`."""


def contracts() -> Layers:
    """The layers that import-linter holds."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    found = project["tool"]["importlinter"]["contracts"]
    return {
        container: each["layers"]
        for each in found
        if each["type"] == "layers"
        for container in each["containers"]
    }


def page() -> Layers:
    """The layers that ARCHITECTURE.md shows: a package on a line, and its own below, indented."""
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    (block,) = (each for each in blocks(text) if each.heading == "Import layers")
    found: dict[str, list[str]] = {}
    for line in block.text.splitlines():
        if line.startswith(" "):
            found[list(found)[-1]].append(line.strip())
        else:
            found[line] = []
    return found


def test_import_layers_are_kept() -> None:
    program = Path(sys.executable).with_name("lint-imports")
    run = subprocess.run(
        [program, "--no-cache"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stdout + run.stderr


def test_the_page_has_the_layers_of_the_contracts() -> None:
    assert page() == contracts()


def test_each_of_our_packages_is_on_the_page() -> None:
    assert {path.parent.name for path in ROOT.glob("src/*/__init__.py")} <= set(page())


@pytest.mark.parametrize("package", contracts())
def test_the_page_names_all_that_a_package_has(package: str) -> None:
    folder = ROOT / "src" / Path(*package.split("."))
    modules = {path.stem for path in folder.glob("*.py")} - {"__init__"}
    packages = {path.parent.name for path in folder.glob("*/__init__.py")}
    named = [name for line in page()[package] for name in line.split(" | ")]
    assert sorted(named) == sorted(modules | packages)


DATA_OF_MESSAGES = {
    "Assignment", "Bound", "CommandField", "CommandTopic", "FieldPath", "Interrupted", "Level",
    "ExclusiveTarget", "Scalar",
}  # fmt: skip
"""The types of reactions that the checker may use: facts about messages and resources."""


def used_of_reactions(path: Path) -> Iterator[str]:
    """The names of `ir.reactions` that a module uses."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        match node:
            case ast.ImportFrom(module="rossmarie.ir.reactions", names=names):
                yield from (each.name for each in names)
            case ast.Attribute(value=ast.Name(id="reactions"), attr=name):
                yield name
            case _:  # open: the nodes of Python
                pass


def test_the_checker_leaves_effects_tasks_and_plans_to_lowering() -> None:
    modules = (ROOT / "src" / "rossmarie" / "check").rglob("*.py")
    used = {name for module in modules for name in used_of_reactions(module)}
    assert used == DATA_OF_MESSAGES
