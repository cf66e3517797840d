"""Users get what the sources import: a tool of developers may not be there."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from importlib.metadata import packages_distributions
from pathlib import Path

from support.packages import projects

ROOT = Path(__file__).parents[2]
OTHERS = {"markupsafe", "glfw", "pyopengl"}
"""Packages that declared ones need in turn: jinja2, and mujoco the others."""


def imported() -> Iterator[tuple[str, str]]:
    """The top-level modules that files of the sources import when they run, at once or later."""
    for path in sorted((ROOT / "src").rglob("*.py")):
        for node in run(ast.parse(path.read_text(encoding="utf-8"))):
            names = [each.name for each in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and node.module and not node.level:
                names = [node.module]
            yield from ((path.name, name.partition(".")[0]) for name in names)


def run(tree: ast.AST) -> Iterator[ast.AST]:
    """The nodes of a module without those that only type checkers look at."""
    yield tree
    for node in ast.iter_child_nodes(tree):
        match node:
            case ast.If(test=ast.Name(id="TYPE_CHECKING"), orelse=otherwise):
                for each in otherwise:
                    yield from run(each)
            case _:
                yield from run(node)


def declared() -> set[str]:
    """The distributions that users install: the needed ones, and those of all extras."""
    return {plain(each.name) for project in projects().values() for each in project.requirements}


def plain(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def test_what_the_sources_import_is_installed_with_them() -> None:
    known, owners = {*declared(), *OTHERS}, packages_distributions()
    missing = {
        (file, module)
        for file, module in imported()
        if module not in sys.stdlib_module_names
        and module in owners
        and not known & {plain(each) for each in owners[module]}
    }
    assert missing == set()
