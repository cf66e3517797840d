"""Texts of findings are declared, with fields, in errors files and not in the code that reports
them.
"""

from __future__ import annotations

import ast
import importlib
import pkgutil
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import crosscheck
import dslkit.diagnostics
import ezskiros
import rossmarie
from dslkit.diagnostics import Remark

SOURCES = Path(__file__).parents[2] / "src"
DECLARING = re.compile(r".*errors\.py|remarks?\.py")
MADE_FROM_TEXTS = ("Diagnostic", "Label")
TEXTS = ("help", "notes")


def loose(file: Path) -> Iterator[str]:
    """The places of a file that hold words of findings and should not."""
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        problem = None
        if isinstance(node, ast.ClassDef):
            if "Remark" in map(name_of, node.bases) and not DECLARING.fullmatch(file.name):
                problem = f"the remark {node.name} belongs into an errors file"
        elif isinstance(node, ast.Call):
            problem = problem_of_call(node)
        if problem is not None:
            assert isinstance(node, ast.stmt | ast.expr)
            yield f"{file.name}:{node.lineno}: {problem}"


def problem_of_call(call: ast.Call) -> str | None:
    """The fault of a call that makes a label or passes a text; None if the call is correct."""
    function = name_of(call.func)
    if function in MADE_FROM_TEXTS:
        return f"{function}(...) by hand: give a remark its place, or a template"
    given = {each.arg: each.value for each in call.keywords if each.arg in TEXTS}
    if function == "replace" and given:
        return "a text put into a finding: `remarked` takes remarks"
    if function == "at" and any(map(is_text, given.values())):
        return "a text for a help or a note: declare a remark"
    return None


def name_of(node: ast.expr) -> str:
    """The last name of `a.b`."""
    return node.attr if isinstance(node, ast.Attribute) else getattr(node, "id", "")


def is_text(node: ast.expr) -> bool:
    """Say whether an expression is a text, a tuple of texts, or a choice of two texts."""
    match node:
        case ast.Constant(value=value):
            return isinstance(value, str)
        case ast.JoinedStr():
            return True
        case ast.Tuple(elts=parts) | ast.List(elts=parts):
            return any(map(is_text, parts))
        case ast.IfExp(body=one, orelse=other):
            return is_text(one) or is_text(other)
        case _:  # open: any other expression, of which mypy knows whether it is a text
            return False


def test_no_words_of_findings_stand_where_they_are_found() -> None:
    files = [each for each in SOURCES.rglob("*.py") if SOURCES / "dslkit" not in each.parents]
    assert [place for file in sorted(files) for place in loose(file)] == []


@pytest.mark.parametrize(
    "text",
    [
        'place = Label(span, "declared here")',
        'found = Diagnostic("ROSS101", "x", Severity.ERROR, "x", place)',
        'found.at(span, help="write it down")',
        'found.at(span, help=f"write {name} down" if name else None)',
        'found.at(span, notes=("it is so",))',
        'replace(found, help="write it down")',
        'class Near(Remark):\n    says = "declared here"',
    ],
)
def test_such_words_are_found(text: str, tmp_path: Path) -> None:
    file = tmp_path / "check.py"
    file.write_text(text, encoding="utf-8")
    assert len([*loose(file)]) == 1


def remarks(kind: type[Remark] = Remark) -> Iterator[type[Remark]]:
    """All remarks that are declared in what has been imported."""
    for each in kind.__subclasses__():
        if each.__module__.startswith(("crosscheck.", "dslkit.", "ezskiros.", "rossmarie.")):
            yield each
        yield from remarks(each)


def test_texts_of_remarks_name_only_fields_that_exist() -> None:
    for package in (dslkit.diagnostics, crosscheck, ezskiros, rossmarie):
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if not module.name.endswith(".__main__"):
                importlib.import_module(module.name)
    found = [*remarks()]
    assert len(found) > 100
    for remark in found:
        remark.check_placeholders()
